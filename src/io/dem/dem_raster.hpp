// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geoloc/projection/height_grid.hpp"

namespace geoloc::io {

/// The first band of a raster file in latitude and longitude (WGS84), in metres.
struct DemRaster {
  HeightGrid::Layout layout;
  std::vector<float> heights_m;  ///< as HeightGrid takes them
  std::string datum;             ///< of the heights, as the file or its format states it; empty: it does not
  bool position_is_assumed = false;  ///< the file does not say that its coordinates are WGS84's
};

/// Throws std::runtime_error with the reason alone.
DemRaster read_dem_raster(const std::filesystem::path& file);

}  // namespace geoloc::io
