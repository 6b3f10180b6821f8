// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/dem/dem_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "io/dem/dem_raster.hpp"

namespace geoloc::io {
namespace {

std::string remarks_on(const HeightGrid& grid, const DemRaster& raster, double share_missing) {
  std::array<char, 200> size{};
  std::snprintf(size.data(), size.size(), "%zu x %zu heights some %.3g m apart, %.0f to %.0f m",
                grid.layout().columns, grid.layout().rows, grid.spacing_m(), grid.least_m(),
                grid.greatest_m());
  std::string remarks = size.data();
  remarks += raster.datum.empty() ? "; above what it does not say: mean sea level is assumed"
                                  : " above " + raster.datum;
  if (raster.position_is_assumed) remarks += "; its coordinates are taken to be WGS84's";
  if (share_missing > 0.0) {
    std::snprintf(size.data(), size.size(), "; %.1f %% of the heights are missing", 100.0 * share_missing);
    remarks += size.data();
  }
  return remarks;
}

}  // namespace

Dem read_dem(const std::filesystem::path& file) {
  try {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) throw std::runtime_error("no such file");
    DemRaster raster = read_dem_raster(file);
    const auto missing = std::count_if(raster.heights_m.begin(), raster.heights_m.end(),
                                       [](float height_m) { return std::isnan(height_m); });
    const double share =
        static_cast<double>(missing) / static_cast<double>(std::max<std::size_t>(raster.heights_m.size(), 1));
    auto grid = std::make_shared<const HeightGrid>(raster.layout, std::move(raster.heights_m));
    std::string remarks = file.string() + ": " + remarks_on(*grid, raster, share);
    return {std::move(grid), std::move(remarks)};
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace geoloc::io
