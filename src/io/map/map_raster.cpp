// SPDX-License-Identifier: Apache-2.0
#include "io/map/map_raster.hpp"

#include <cpl_vsi.h>
#include <gdal_utils.h>
#include <gdalwarper.h>
#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <vector>

namespace geoloc::io {
namespace {

constexpr const char* kWebMercator = "EPSG:3857";
constexpr double kHalfWorld_m = 20037508.342789244;
constexpr int kTile_px = 256;
constexpr GIntBig kCacheBytes = 64 << 20;  // by default, GDAL takes a twentieth of the memory

/// While it lives, GDAL reads and writes no files beside those that it is told to.
class NoSideFiles {
 public:
  NoSideFiles() { CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", "NO"); }
  ~NoSideFiles() { CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", nullptr); }
  NoSideFiles(const NoSideFiles&) = delete;
  NoSideFiles& operator=(const NoSideFiles&) = delete;
};

/// A null-terminated list for GDAL's functions.
class Arguments {
 public:
  Arguments(std::initializer_list<std::string> texts) : texts_(texts) {
    for (std::string& text : texts_) pointers_.push_back(text.data());
    pointers_.push_back(nullptr);
  }
  char** data() { return pointers_.data(); }

 private:
  std::vector<std::string> texts_;
  std::vector<char*> pointers_;
};

template <class Options, class Run>
GdalDataset run_tool(Options* options, void (*free_options)(Options*), const Run& run) {
  const std::unique_ptr<Options, void (*)(Options*)> owned(options, free_options);
  int misused = 0;
  return GdalDataset(run(owned.get(), &misused));
}

GdalDataset translate(GDALDatasetH source, Arguments arguments) {
  return run_tool(GDALTranslateOptionsNew(arguments.data(), nullptr), &GDALTranslateOptionsFree,
                  [&](auto* options, int* misused) { return GDALTranslate("", source, options, misused); });
}

GdalDataset warp(GDALDatasetH source, Arguments arguments) {
  return run_tool(
      GDALWarpAppOptionsNew(arguments.data(), nullptr), &GDALWarpAppOptionsFree,
      [&](auto* options, int* misused) { return GDALWarp("", nullptr, 1, &source, options, misused); });
}

GdalDataset open(const std::filesystem::path& file, const std::vector<const char*>& formats, const char* what,
                 const GdalErrors& errors) {
  GDALAllRegister();
  GDALSetCacheMax64(kCacheBytes);
  std::vector<const char*> list = formats;
  list.push_back(nullptr);
  GdalDataset raster(
      GDALOpenEx(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, list.data(), nullptr, nullptr));
  if (!raster) errors.fail(std::string("not ") + what);
  return raster;
}

/// As red, green and blue, or grey, with transparency where there is one.
GdalDataset in_colours(GDALDatasetH source) {
  const int bands = GDALGetRasterCount(source);
  const GDALRasterBandH first = GDALGetRasterBand(source, 1);
  if (GDALGetRasterColorTable(first) != nullptr) return translate(source, {"-of", "VRT", "-expand", "rgb"});
  const bool has_fourth_colour =
      bands >= 4 && GDALGetRasterColorInterpretation(GDALGetRasterBand(source, 4)) != GCI_AlphaBand;
  if (has_fourth_colour) return translate(source, {"-of", "VRT", "-b", "1", "-b", "2", "-b", "3"});
  return translate(source, {"-of", "VRT"});
}

/// Distances in Web Mercator are longer than true ones by this factor.
double stretch_at(const MercatorArea& area) {
  constexpr double kEarthRadius_m = 6378137.0;
  return std::cosh(0.5 * (area.south + area.north) / kEarthRadius_m);
}

std::string take_file(const std::string& name) {
  vsi_l_offset size = 0;
  GByte* const bytes = VSIGetMemFileBuffer(name.c_str(), &size, TRUE);
  if (bytes == nullptr) return {};
  std::string content(reinterpret_cast<const char*>(bytes), size);
  VSIFree(bytes);
  return content;
}

std::string png_of(GDALDatasetH raster) {
  const std::string name =
      "/vsimem/geoloc-" + std::to_string(reinterpret_cast<std::uintptr_t>(raster)) + ".png";
  const GDALDriverH driver = GDALGetDriverByName("PNG");
  if (driver == nullptr) return {};
  GdalDataset(GDALCreateCopy(driver, name.c_str(), raster, FALSE, nullptr, nullptr, nullptr)).reset();
  return take_file(name);
}

}  // namespace

MercatorArea area_of(const TileAddress& tile) {
  const double size = std::ldexp(2.0 * kHalfWorld_m, -tile.z);
  const double west = -kHalfWorld_m + tile.x * size, north = kHalfWorld_m - tile.y * size;
  return {west, north - size, west + size, north};
}

bool overlap(const MercatorArea& a, const MercatorArea& b) {
  return a.west < b.east && b.west < a.east && a.south < b.north && b.south < a.north;
}

MercatorArea mercator_area(GDALDatasetH raster) {
  const GdalErrors errors;
  if (GDALGetSpatialRef(raster) == nullptr)
    throw std::runtime_error("does not say where it lies (gdal_edit.py -a_srs tells its projection)");
  const OGRSpatialReferenceH mercator = OSRNewSpatialReference(nullptr);
  OSRSetFromUserInput(mercator, kWebMercator);
  char* text = nullptr;
  OSRExportToWkt(mercator, &text);
  const GdalDataset warped(
      GDALAutoCreateWarpedVRT(raster, nullptr, text, GRA_NearestNeighbour, 0.0, nullptr));
  CPLFree(text);
  OSRDestroySpatialReference(mercator);
  std::array<double, 6> transform{};
  if (!warped || GDALGetGeoTransform(warped.get(), transform.data()) != CE_None)
    errors.fail("does not say where it lies");
  const double width = transform[1] * GDALGetRasterXSize(warped.get());
  const double height = transform[5] * GDALGetRasterYSize(warped.get());
  return {transform[0], transform[3] + height, transform[0] + width, transform[3]};
}

MapRaster open_picture(const std::filesystem::path& file) {
  const GdalErrors errors;
  const NoSideFiles alone;
  GdalDataset source = open(file, {"GTiff", "MBTiles"}, "a map (GeoTIFF, or MBTiles of pictures)", errors);
  if (GDALGetRasterCount(source.get()) < 1) throw std::runtime_error("holds no picture");
  if (GDALGetRasterDataType(GDALGetRasterBand(source.get(), 1)) != GDT_Byte)
    throw std::runtime_error("its colours do not have 8 bits (gdal_translate -ot Byte -scale makes them so)");
  GdalDataset coloured = in_colours(source.get());
  if (!coloured) errors.fail("its colours cannot be read");
  return {std::move(source), std::move(coloured)};
}

MapRaster open_relief(const std::filesystem::path& file) {
  const GdalErrors errors;
  const NoSideFiles alone;
  const GdalDataset source =
      open(file, {"GTiff", "SRTMHGT", "DTED", "AAIGrid"}, "an elevation model", errors);
  const double stretch = stretch_at(mercator_area(source.get()));
  const GdalDataset heights = warp(source.get(), {"-of", "MEM", "-ot", "Float32", "-t_srs", kWebMercator,
                                                  "-r", "bilinear", "-dstnodata", "-32768"});
  if (!heights) errors.fail("cannot be turned into the map's projection");
  Arguments shading{"-of", "MEM", "-compute_edges", "-alt", "60", "-s", std::to_string(stretch)};
  GdalDataset relief =
      run_tool(GDALDEMProcessingOptionsNew(shading.data(), nullptr), &GDALDEMProcessingOptionsFree,
               [&](auto* options, int* misused) {
                 return GDALDEMProcessing("", heights.get(), "hillshade", nullptr, options, misused);
               });
  if (!relief) errors.fail("cannot be shaded");
  return {nullptr, std::move(relief)};
}

std::string attribution_of(GDALDatasetH raster) {
  for (const char* const name : {"attribution", "TIFFTAG_COPYRIGHT"}) {
    if (const char* const text = GDALGetMetadataItem(raster, name, nullptr)) return text;
  }
  return {};
}

std::optional<std::string> cut_png(GDALDatasetH raster, const MercatorArea& area) {
  const GdalErrors errors;
  const NoSideFiles alone;
  const auto text = [](double number) { return std::to_string(number); };
  const std::string side = std::to_string(kTile_px);
  const GdalDataset tile =
      warp(raster, {"-of", "MEM", "-t_srs", kWebMercator, "-te", text(area.west), text(area.south),
                    text(area.east), text(area.north), "-ts", side, side, "-r", "bilinear", "-dstalpha"});
  std::string png = tile ? png_of(tile.get()) : std::string{};
  return png.empty() ? std::nullopt : std::optional(std::move(png));
}

}  // namespace geoloc::io
