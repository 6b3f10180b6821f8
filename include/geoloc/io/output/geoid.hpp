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

/// Mean sea level relative to the WGS84 ellipsoid, from EGM96 if GeographicLib's data for it are installed
/// (`geographiclib-get-geoids egm96-5`).
class Geoid {
 public:
  /// `folder` has the data; if empty, GeographicLib's default folder and GEOGRAPHICLIB_GEOID_PATH apply.
  explicit Geoid(const std::string& folder = {});
  ~Geoid();
  Geoid(const Geoid&) = delete;
  Geoid& operator=(const Geoid&) = delete;

  bool is_installed() const { return geoid_ != nullptr; }

  /// nullopt without data, or if they cannot be read.
  std::optional<double> height_ellipsoid_m(const Geodetic& position, double height_msl_m) const;

 private:
  std::unique_ptr<const GeographicLib::Geoid> geoid_;
};

}  // namespace geoloc::io
