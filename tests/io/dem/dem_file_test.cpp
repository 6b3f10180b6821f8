// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/dem/dem_file.hpp"

#include <cpl_conv.h>
#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/geodetic.hpp"

namespace geoloc::io {
namespace {

namespace fs = std::filesystem;

/// A raster to be written by GDAL: heights by the coordinates of the cells' middles.
struct Raster {
  std::string format = "GTiff";
  std::string projection = "EPSG:4326";
  std::array<double, 6> transform{7.0, 0.001, 0.0, 46.1, 0.0, -0.001};
  bool is_placed = true;
  int columns = 60, rows = 50;
  std::function<double(double x, double y)> height = [](double, double) { return 0.0; };
  std::optional<double> nodata;
  std::string unit;
  double scale = 1.0, offset = 0.0;
};

class DemFiles : public ::testing::Test {
 protected:
  DemFiles() {
    GDALAllRegister();
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("dem_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }

  fs::path write(const std::string& name, const Raster& raster) const {
    const GDALDriverH driver = GDALGetDriverByName(raster.format.c_str());
    const GDALDatasetH dataset =
        GDALCreate(driver, file(name).c_str(), raster.columns, raster.rows, 1, GDT_Float32, nullptr);
    auto transform = raster.transform;
    if (raster.is_placed) GDALSetGeoTransform(dataset, transform.data());
    if (!raster.projection.empty()) {
      const OGRSpatialReferenceH srs = OSRNewSpatialReference(nullptr);
      OSRSetFromUserInput(srs, raster.projection.c_str());
      GDALSetSpatialRef(dataset, srs);
      OSRDestroySpatialReference(srs);
    }
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    if (raster.nodata) GDALSetRasterNoDataValue(band, *raster.nodata);
    if (!raster.unit.empty()) GDALSetRasterUnitType(band, raster.unit.c_str());
    if (raster.scale != 1.0) GDALSetRasterScale(band, raster.scale);
    if (raster.offset != 0.0) GDALSetRasterOffset(band, raster.offset);
    for (int row = 0; row < raster.rows; ++row) {
      std::vector<float> line;
      for (int column = 0; column < raster.columns; ++column) {
        const auto& t = raster.transform;
        line.push_back(static_cast<float>(raster.height(t[0] + (column + 0.5) * t[1] + (row + 0.5) * t[2],
                                                        t[3] + (column + 0.5) * t[4] + (row + 0.5) * t[5])));
      }
      EXPECT_EQ(GDALRasterIO(band, GF_Write, 0, row, raster.columns, 1, line.data(), raster.columns, 1,
                             GDT_Float32, 0, 0),
                CE_None);
    }
    GDALClose(dataset);
    return file(name);
  }

  static std::string refusal(const fs::path& file) {
    try {
      read_dem(file);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "read";
  }

 private:
  fs::path folder_;
};

bool mentions(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

/// GDAL's own program, where it is installed.
std::optional<double> gdallocationinfo(const fs::path& file, const Geodetic& place) {
  std::array<char, 400> command{};
  std::snprintf(command.data(), command.size(),
                "gdallocationinfo -valonly -wgs84 '%s' %.12f %.12f 2>/dev/null", file.c_str(),
                place.longitude_deg, place.latitude_deg);
  FILE* const output = popen(command.data(), "r");
  double value = 0.0;
  const bool is_read = output != nullptr && std::fscanf(output, "%lf", &value) == 1;
  if (output != nullptr) pclose(output);
  return is_read ? std::optional(value) : std::nullopt;
}

double rolling(double x, double y) {
  return 400.0 + 50.0 * std::sin(300.0 * x) + 30.0 * std::cos(200.0 * y);
}

TEST_F(DemFiles, InDegreesHaveTheirHeightsAtTheMiddlesOfTheirCells) {
  Raster raster;
  raster.height = rolling;
  const Dem dem = read_dem(write("plain.tif", raster));
  for (int row = 0; row < raster.rows; row += 24) {
    for (int column = 0; column < raster.columns; column += 29) {
      const Geodetic middle{46.1 - 0.001 * (row + 0.5), 7.0 + 0.001 * (column + 0.5)};
      const auto here = dem.heights->at(middle);
      ASSERT_TRUE(here);
      EXPECT_NEAR(here->height_m, rolling(middle.longitude_deg, middle.latitude_deg), 1e-3);
      EXPECT_LT(here->beyond_m, 1e-6);
      const double by_gdal = gdallocationinfo(file("plain.tif"), middle).value_or(here->height_m);
      EXPECT_NEAR(here->height_m, by_gdal, 1e-3);
    }
  }
}

/// Cells of 25 m: what GDAL's program says of the cell under a place differs by half a cell's rise.
TEST_F(DemFiles, InAProjectionHaveTheirHeightsWhereTheProjectionPutsThem) {
  const std::vector<std::string> projections{"EPSG:32632", "EPSG:25832"};
  for (const std::string& projection : projections) {
    Raster raster;
    raster.projection = projection;
    raster.transform = {400000.0, 25.0, 0.0, 5100000.0, 0.0, -25.0};
    raster.height = [](double x, double y) { return 0.02 * (x - 400000.0) - 0.03 * (y - 5100000.0); };
    const Dem dem = read_dem(write("utm.tif", raster));
    int inside = 0;
    for (double latitude_deg = 46.03; latitude_deg < 46.05; latitude_deg += 0.0021) {
      for (double longitude_deg = 7.71; longitude_deg < 7.725; longitude_deg += 0.0017) {
        const Geodetic place{latitude_deg, longitude_deg};
        const auto utm = to_utm(place);
        const double x = utm->easting_m - 400000.0, y = utm->northing_m - 5100000.0;
        if (x < 50.0 || x > 1450.0 || y > -50.0 || y < -1200.0) continue;
        ++inside;
        const auto here = dem.heights->at(place);
        ASSERT_TRUE(here);
        EXPECT_NEAR(here->height_m, 0.02 * x - 0.03 * y, 0.05) << projection;
        if (inside % 10 != 1) continue;
        const double by_gdal = gdallocationinfo(file("utm.tif"), place).value_or(here->height_m);
        EXPECT_NEAR(here->height_m, by_gdal, 0.05 + 12.5 * (0.02 + 0.03));
      }
    }
    EXPECT_GT(inside, 5);
  }
}

TEST_F(DemFiles, HaveNoHeightsOutsideOfWhatAProjectionCovers) {
  Raster raster;
  raster.projection = "EPSG:32632";
  raster.transform = {700000.0, 25.0, 0.0, 5100000.0, 0.0, -25.0};  // turned against the meridians
  raster.height = [](double, double) { return 500.0; };
  const Dem dem = read_dem(write("turned.tif", raster));
  EXPECT_EQ(dem.heights->least_m(), 500.0);
  EXPECT_TRUE(mentions(dem.remarks, "missing"));
}

TEST_F(DemFiles, HaveHolesWhereTheirNodataIsAndWhereNoHeightCanBe) {
  for (const double hole : {-32768.0, -9999.0, 1e30, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()}) {
    Raster raster;
    raster.nodata = hole == -9999.0 ? std::optional(hole) : std::nullopt;
    raster.height = [&](double x, double) { return x < 7.03 ? 100.0 : hole; };
    const Dem dem = read_dem(write("holes.tif", raster));
    ASSERT_TRUE(dem.heights->at({46.08, 7.02}));
    EXPECT_EQ(dem.heights->at({46.08, 7.02})->height_m, 100.0);
    EXPECT_FALSE(dem.heights->at({46.08, 7.05})) << hole;
    EXPECT_TRUE(mentions(dem.remarks, "missing"));
  }
}

TEST_F(DemFiles, HaveMetresWhateverTheirUnitScaleAndOffsetAre) {
  Raster raster;
  raster.height = [](double, double) { return 1000.0; };
  raster.unit = "ft";
  EXPECT_NEAR(read_dem(write("feet.tif", raster)).heights->greatest_m(), 304.8, 1e-3);
  raster.unit = "m";
  raster.scale = 0.1;
  raster.offset = 7.0;
  EXPECT_NEAR(read_dem(write("scaled.tif", raster)).heights->greatest_m(), 107.0, 1e-3);
  raster.unit = "bananas";
  EXPECT_TRUE(mentions(refusal(write("unit.tif", raster)), "bananas"));
}

TEST_F(DemFiles, SayWhatTheirHeightsCountFromOrThatItIsAssumed) {
  Raster raster;
  EXPECT_TRUE(mentions(read_dem(write("silent.tif", raster)).remarks, "mean sea level is assumed"));
  raster.projection = "EPSG:4326+5773";
  EXPECT_TRUE(mentions(read_dem(write("stated.tif", raster)).remarks, "EGM96"));
  raster.projection.clear();
  EXPECT_TRUE(mentions(read_dem(write("assumed.tif", raster)).remarks, "taken to be WGS84's"));
}

/// The format has no header: 1201 x 1201 numbers of two bytes, the most significant first, from north to
/// south, over a degree whose corner the name tells.
TEST_F(DemFiles, OfSrtmAreReadToTheTilesEdges) {
  const fs::path tile = file("N46E007.hgt");
  std::ofstream stream(tile, std::ios::binary);
  for (int row = 0; row <= 1200; ++row) {
    for (int column = 0; column <= 1200; ++column) {
      const int height_m = 500 + row + column / 2;
      stream.put(static_cast<char>(height_m >> 8)).put(static_cast<char>(height_m & 0xFF));
    }
  }
  stream.close();
  const Dem dem = read_dem(tile);
  EXPECT_TRUE(mentions(dem.remarks, "EGM96"));
  const auto height_m = [&](double latitude_deg, double longitude_deg) {
    const auto here = dem.heights->at({latitude_deg, longitude_deg});
    return here && here->beyond_m < 1e-3 ? here->height_m : std::nan("");
  };
  EXPECT_NEAR(height_m(47.0, 7.0), 500.0, 1e-3);
  EXPECT_NEAR(height_m(46.0, 7.0), 1700.0, 1e-3);
  EXPECT_NEAR(height_m(46.0, 8.0), 2300.0, 1e-3);
  EXPECT_NEAR(height_m(46.5, 7.5), 500.0 + 600.0 + 300.0, 1e-3);
  const auto beyond = dem.heights->at({46.5, 8.001});
  ASSERT_TRUE(beyond);
  EXPECT_NEAR(beyond->height_m, 1700.0, 1e-3);
  EXPECT_NEAR(beyond->beyond_m, 0.001 * 111.2e3 * std::cos(46.5 * 3.14159265 / 180.0), 0.1);
}

// --- What is none.

TEST_F(DemFiles, ThatAreNoneAreRefusedByName) {
  EXPECT_TRUE(mentions(refusal(file("missing.tif")), "missing.tif: no such file"));
  EXPECT_TRUE(mentions(refusal(file("")), "no such file"));
  std::ofstream(file("text.tif")) << "not a picture";
  EXPECT_TRUE(mentions(refusal(file("text.tif")), "text.tif: not an elevation model"));
  std::ofstream(file("empty.hgt")) << "";
  EXPECT_TRUE(mentions(refusal(file("empty.hgt")), "not an elevation model"));
  EXPECT_TRUE(mentions(refusal("/vsicurl/http://127.0.0.1:9/a.tif"), "no such file"));
}

TEST_F(DemFiles, WithoutAPlaceAreRefused) {
  Raster raster;
  raster.is_placed = false;
  raster.projection.clear();
  EXPECT_TRUE(mentions(refusal(write("nowhere.tif", raster)), "georeference"));
  raster.is_placed = true;
  raster.transform = {400000.0, 25.0, 0.0, 5100000.0, 0.0, -25.0};
  EXPECT_TRUE(mentions(refusal(write("metres.tif", raster)), "projection"));
  raster.projection = "EPSG:4326";
  raster.transform = {400.0, 25.0, 0.0, 5100.0, 0.0, -25.0};  // of degrees
  EXPECT_NE(refusal(write("off_earth.tif", raster)), "read");
}

TEST_F(DemFiles, OfNothingAreRefused) {
  Raster raster;
  raster.height = [](double, double) { return std::nan(""); };
  EXPECT_TRUE(mentions(refusal(write("nan.tif", raster)), "no height"));
  raster.columns = 1;
  raster.height = rolling;
  EXPECT_NE(refusal(write("narrow.tif", raster)), "read");
}

TEST_F(DemFiles, CutAnywhereAreReadOrRefusedAndNeverCrash) {
  Raster raster;
  raster.height = rolling;
  const fs::path whole = write("whole.tif", raster);
  std::ifstream stream(whole, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t length = 0; length < bytes.size(); length += 97) {
    std::ofstream(file("cut.tif"), std::ios::binary) << bytes.substr(0, length);
    refusal(file("cut.tif"));
  }
  std::ofstream(file("half.tif"), std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  EXPECT_TRUE(mentions(refusal(file("half.tif")), "half.tif: ")) << refusal(file("half.tif"));
}

/// Sparse files may announce any size.
TEST_F(DemFiles, ThatAnnounceHugeSizesAreRefusedBeforeTheyAreRead) {
  const char* options[] = {"SPARSE_OK=TRUE", nullptr};
  const GDALDatasetH dataset = GDALCreate(GDALGetDriverByName("GTiff"), file("huge.tif").c_str(), 100000,
                                          100000, 1, GDT_Float32, const_cast<char**>(options));
  std::array<double, 6> transform{7.0, 1e-5, 0.0, 46.0, 0.0, -1e-5};
  GDALSetGeoTransform(dataset, transform.data());
  GDALClose(dataset);
  EXPECT_TRUE(mentions(refusal(file("huge.tif")), "too large"));
}

}  // namespace
}  // namespace geoloc::io
