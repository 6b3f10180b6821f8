// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/geoid.hpp"

#include <GeographicLib/Geoid.hpp>
#include <cmath>

namespace geoloc::io {
namespace {

/// nullptr where the file is not there, or damaged.
std::unique_ptr<const GeographicLib::Geoid> read(const std::string& name, const std::string& folder) {
  constexpr bool kCubic = true, kAllInMemory = true;
  try {
    return std::make_unique<GeographicLib::Geoid>(name, folder, kCubic, kAllInMemory);
  } catch (const GeographicLib::GeographicErr&) {
    return nullptr;
  }
}

}  // namespace

Geoid::Geoid(const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    for (const char* name : {"egm96-5", "egm96-15"}) {
      if (!geoid_) geoid_ = read(name, folder);
    }
  }
}

Geoid::~Geoid() = default;
Geoid::Geoid(Geoid&&) noexcept = default;
Geoid& Geoid::operator=(Geoid&&) noexcept = default;

std::optional<double> Geoid::height_ellipsoid_m(const Geodetic& position, double height_msl_m) const {
  if (!geoid_ || !is_valid(position) || !std::isfinite(height_msl_m)) return std::nullopt;
  return height_msl_m + (*geoid_)(position.latitude_deg, position.longitude_deg);
}

void Geoid::complete(std::vector<ObjectReport>& objects) const {
  for (ObjectReport& object : objects) complete(object.position, object.height);
}

void Geoid::complete(const Geodetic& position, HeightReport& height) const {
  if (height.msl_m) height.ellipsoid_m = height_ellipsoid_m(position, *height.msl_m);
}

}  // namespace geoloc::io
