// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "geoloc/projection/height_grid.hpp"

namespace geoloc::io {

/// A digital elevation model as the estimator takes it.
struct Dem {
  std::shared_ptr<const HeightGrid> heights;
  std::string remarks;  ///< size and datum, and what was assumed where the file does not say: for the user
};

/// GeoTIFF in any projection, SRTM's `.hgt`, DTED, or an ESRI ASCII grid; its first band. Nodata and values
/// that are no heights on Earth are left out. Throws std::runtime_error with the file and the reason: where
/// it is none of these, damaged, without georeference, or larger than 64 million heights; and always where
/// geoloc was built without GDAL.
Dem read_dem(const std::filesystem::path& file);

}  // namespace geoloc::io
