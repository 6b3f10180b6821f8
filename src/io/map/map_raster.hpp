// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "geoloc/io/map/map_tiles.hpp"
#include "io/gdal_dataset.hpp"

namespace geoloc::io {

/// A rectangle of the Web Mercator projection (EPSG:3857) [m]: positions / cos(latitude).
struct MercatorArea {
  double west = 0.0;
  double south = 0.0;
  double east = 0.0;
  double north = 0.0;
};

MercatorArea area_of(const TileAddress& tile);

bool overlap(const MercatorArea& a, const MercatorArea& b);

/// What a raster covers. Throws std::runtime_error where it does not say where it lies.
MercatorArea mercator_area(GDALDatasetH raster);

/// A view of a file: GDAL's views do not keep open what they show.
struct MapRaster {
  GdalDataset file;  // first: it is closed last
  GdalDataset shown;
};

/// One, three or four bands of 8 bits. Throws std::runtime_error with the reason and the remedy.
MapRaster open_picture(const std::filesystem::path& file);

/// An elevation model in Web Mercator, as light and shadow.
MapRaster open_relief(const std::filesystem::path& file);

/// What its maker wants to be read beside it.
std::string attribution_of(GDALDatasetH raster);

/// A tile as PNG, transparent where the raster has nothing; nullopt where it cannot be read.
std::optional<std::string> cut_png(GDALDatasetH raster, const MercatorArea& area);

}  // namespace geoloc::io
