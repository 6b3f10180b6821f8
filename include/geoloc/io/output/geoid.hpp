// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "geoloc/geometry/geodetic.hpp"

namespace GeographicLib {
class Geoid;
}

namespace geoloc::io {

/// Mean sea level against the WGS84 ellipsoid, by EGM96 where GeographicLib's data for it are installed
/// (`geographiclib-get-geoids egm96-5`).
class Geoid {
 public:
  /// `folder`: of the data; empty: GeographicLib's own, and GEOGRAPHICLIB_GEOID_PATH.
  explicit Geoid(const std::string& folder = {});
  ~Geoid();
  Geoid(const Geoid&) = delete;
  Geoid& operator=(const Geoid&) = delete;

  bool is_installed() const { return geoid_ != nullptr; }

  /// nullopt without data, or where they cannot be read.
  std::optional<double> height_ellipsoid_m(const Geodetic& position, double height_msl_m) const;

 private:
  std::unique_ptr<const GeographicLib::Geoid> geoid_;
};

}  // namespace geoloc::io
