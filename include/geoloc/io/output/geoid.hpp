// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/io/output/object_report.hpp"

namespace GeographicLib {
class Geoid;
}

namespace geoloc::io {

/// Mean sea level relative to the WGS84 ellipsoid: EGM96, in GeographicLib's files. All of it is in memory,
/// so that nobody waits for a disk later, and several threads may ask.
class Geoid {
 public:
  /// The first of the folders that has egm96-5.pgm or egm96-15.pgm counts; an empty one stands for
  /// GeographicLib's default, or GEOGRAPHICLIB_GEOID_PATH.
  explicit Geoid(const std::vector<std::string>& folders = {""});
  ~Geoid();
  Geoid(Geoid&&) noexcept;
  Geoid& operator=(Geoid&&) noexcept;

  bool is_installed() const { return geoid_ != nullptr; }

  /// nullopt without data.
  std::optional<double> height_ellipsoid_m(const Geodetic& position, double height_msl_m) const;

  /// The heights above the ellipsoid of all objects whose heights above the sea are known.
  void complete(std::vector<ObjectReport>& objects) const;

  /// The height above the ellipsoid of what is at that position, where its height above the sea is known.
  void complete(const Geodetic& position, HeightReport& height) const;

 private:
  std::unique_ptr<const GeographicLib::Geoid> geoid_;
};

}  // namespace geoloc::io
