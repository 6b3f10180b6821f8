// SPDX-License-Identifier: Apache-2.0
#include "io/dem/dem_raster.hpp"

#include <gdal.h>
#include <gdal_frmts.h>
#include <gdal_utils.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>

#include "io/gdal_dataset.hpp"

namespace geoloc::io {
namespace {

constexpr double kMostHeights = 64e6;
/// No ground on Earth is higher or deeper.
constexpr double kMostHeight_m = 12e3;
constexpr const char* kWgs84 = "EPSG:4326";

/// The formats of elevation models, and what warping needs. Registered twice they are registered once.
void register_formats() {
  GDALRegister_GTiff();
  GDALRegister_SRTMHGT();
  GDALRegister_DTED();
  GDALRegister_AAIGrid();
  GDALRegister_MEM();
}

GdalDataset open(const std::filesystem::path& file, const GdalErrors& errors) {
  constexpr std::array<const char*, 5> kFormats{"GTiff", "SRTMHGT", "DTED", "AAIGrid", nullptr};
  GdalDataset dataset(
      GDALOpenEx(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, kFormats.data(), nullptr, nullptr));
  if (!dataset) errors.fail("not an elevation model (GeoTIFF, .hgt, DTED or ASCII grid)");
  if (GDALGetRasterCount(dataset.get()) < 1) throw std::runtime_error("holds no band");
  return dataset;
}

using GeoTransform = std::array<double, 6>;

GeoTransform transform_of(GDALDatasetH dataset) {
  GeoTransform transform{};
  const bool is_placed =
      GDALGetGeoTransform(dataset, transform.data()) == CE_None &&
      std::all_of(transform.begin(), transform.end(), [](double x) { return std::isfinite(x); });
  if (!is_placed) throw std::runtime_error("holds no georeference: nothing says where its heights are");
  return transform;
}

void refuse_too_large(GDALDatasetH dataset) {
  const double columns = GDALGetRasterXSize(dataset), rows = GDALGetRasterYSize(dataset);
  if (!(columns * rows <= kMostHeights))
    throw std::runtime_error("is too large, " + std::to_string(static_cast<long long>(columns)) + " x " +
                             std::to_string(static_cast<long long>(rows)) +
                             " heights; cut out what is flown over (gdalwarp -te, gdal_translate -projwin)");
}

bool is_in_degrees(const GeoTransform& transform, GDALDatasetH dataset) {
  const double width = transform[1] * GDALGetRasterXSize(dataset);
  const double height = transform[5] * GDALGetRasterYSize(dataset);
  return std::abs(transform[0]) <= 360.0 && std::abs(width) <= 360.0 && std::abs(transform[3]) <= 90.1 &&
         std::abs(transform[3] + height) <= 90.1;
}

bool is_wgs84(OGRSpatialReferenceH srs) {
  if (OSRIsGeographic(srs) == 0) return false;
  const char* const datum = OSRGetAttrValue(srs, "DATUM", 0);
  const char* const meridian = OSRGetAttrValue(srs, "PRIMEM", 1);
  constexpr double kRadPerDegree = 0.017453292519943295;
  return datum != nullptr && std::strstr(datum, "WGS_1984") != nullptr &&
         (meridian == nullptr || std::atof(meridian) == 0.0) &&
         std::abs(OSRGetAngularUnits(srs, nullptr) - kRadPerDegree) < 1e-9;
}

/// In latitude and longitude, by bilinear resampling; what lies outside of the file has no height.
GdalDataset warped(GDALDatasetH source, const GdalErrors& errors) {
  std::array<const char*, 11> arguments{"-of", "MEM",      "-ot",        "Float32", "-t_srs", kWgs84,
                                        "-r",  "bilinear", "-dstnodata", "nan",     nullptr};
  const std::unique_ptr<GDALWarpAppOptions, decltype(&GDALWarpAppOptionsFree)> options(
      GDALWarpAppOptionsNew(const_cast<char**>(arguments.data()), nullptr), &GDALWarpAppOptionsFree);
  int misused = 0;
  GdalDataset result(GDALWarp("", nullptr, 1, &source, options.get(), &misused));
  if (!result) errors.fail("its projection cannot be turned into latitude and longitude");
  refuse_too_large(result.get());
  return result;
}

/// Heights have the unit of their band.
double metres_per_unit(GDALRasterBandH band) {
  const std::string unit = GDALGetRasterUnitType(band);
  if (unit.empty() || unit == "m" || unit == "metre" || unit == "meter" || unit == "metres" ||
      unit == "meters")
    return 1.0;
  if (unit == "ft" || unit == "foot" || unit == "feet") return 0.3048;
  if (unit == "us-ft" || unit == "US survey foot") return 1200.0 / 3937.0;
  throw std::runtime_error("its heights are in '" + unit + "', neither metres nor feet");
}

/// From north to south, as GDAL has them; not a number where there is none.
std::vector<float> heights_of(GDALDatasetH dataset, const GdalErrors& errors) {
  const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
  const int columns = GDALGetRasterXSize(dataset), rows = GDALGetRasterYSize(dataset);
  std::vector<float> heights_m(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const CPLErr status =
      GDALRasterIO(band, GF_Read, 0, 0, columns, rows, heights_m.data(), columns, rows, GDT_Float32, 0, 0);
  if (status != CE_None) errors.fail("damaged or cut off");
  int has_nodata = 0;
  const auto nodata = static_cast<float>(GDALGetRasterNoDataValue(band, &has_nodata));
  const double unit_m = metres_per_unit(band);
  const double scale = unit_m * GDALGetRasterScale(band, nullptr);
  const double offset_m = unit_m * GDALGetRasterOffset(band, nullptr);
  for (float& height_m : heights_m) {
    const double value_m = scale * height_m + offset_m;
    const bool is_missing = has_nodata != 0 && height_m == nodata;
    height_m = !is_missing && std::abs(value_m) <= kMostHeight_m ? static_cast<float>(value_m)
                                                                 : std::numeric_limits<float>::quiet_NaN();
  }
  return heights_m;
}

void turn_upside_down(std::vector<float>& heights_m, std::size_t columns) {
  const std::size_t rows = heights_m.size() / columns;
  for (std::size_t row = 0; row < rows / 2; ++row) {
    const auto upper = heights_m.begin() + static_cast<std::ptrdiff_t>(row * columns);
    const auto lower = heights_m.begin() + static_cast<std::ptrdiff_t>((rows - 1 - row) * columns);
    std::swap_ranges(upper, upper + static_cast<std::ptrdiff_t>(columns), lower);
  }
}

/// What heights of the file count from.
std::string datum_of(GDALDatasetH dataset, OGRSpatialReferenceH srs) {
  if (srs != nullptr) {
    if (const char* const vertical = OSRGetAttrValue(srs, "VERT_CS", 0)) return vertical;
    if (OSRGetAxesCount(srs) == 3) return "the ellipsoid";
  }
  const std::string format = GDALGetDriverShortName(GDALGetDatasetDriver(dataset));
  return format == "SRTMHGT" || format == "DTED" ? "the geoid EGM96, as all of its format" : "";
}

/// GDAL's transform is that of the cells' corners; the heights are those of their middles.
HeightGrid::Layout layout_of(GDALDatasetH dataset, const GeoTransform& transform) {
  HeightGrid::Layout layout;
  layout.columns = static_cast<std::size_t>(GDALGetRasterXSize(dataset));
  layout.rows = static_cast<std::size_t>(GDALGetRasterYSize(dataset));
  layout.longitude_step_deg = transform[1];
  layout.latitude_step_deg = -transform[5];
  layout.west_deg = transform[0] + 0.5 * transform[1];
  layout.south_deg = transform[3] + (static_cast<double>(layout.rows) - 0.5) * transform[5];
  return layout;
}

}  // namespace

DemRaster read_dem_raster(const std::filesystem::path& file) {
  const GdalErrors errors;
  register_formats();
  GdalDataset dataset = open(file, errors);
  refuse_too_large(dataset.get());
  GeoTransform transform = transform_of(dataset.get());
  const OGRSpatialReferenceH srs = GDALGetSpatialRef(dataset.get());
  DemRaster raster;
  raster.datum = datum_of(dataset.get(), srs);
  raster.position_is_assumed = srs == nullptr;
  if (srs == nullptr && !is_in_degrees(transform, dataset.get()))
    throw std::runtime_error(
        "does not say what projection its coordinates are in (gdal_edit.py -a_srs tells it)");
  const bool is_upright =
      transform[1] > 0.0 && transform[5] < 0.0 && transform[2] == 0.0 && transform[4] == 0.0;
  if (!is_upright || (srs != nullptr && !is_wgs84(srs))) {
    if (srs == nullptr) throw std::runtime_error("is turned, and does not say what its coordinates are");
    dataset = warped(dataset.get(), errors);
    transform = transform_of(dataset.get());
  }
  raster.layout = layout_of(dataset.get(), transform);
  raster.heights_m = heights_of(dataset.get(), errors);
  turn_upside_down(raster.heights_m, raster.layout.columns);
  return raster;
}

}  // namespace geoloc::io
