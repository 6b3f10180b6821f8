// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/geoid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

/// A world on which the sea stands as high above the ellipsoid everywhere, in GeographicLib's format.
void write_flat_geoid(const std::filesystem::path& file_name, double height_m) {
  std::ofstream file(file_name, std::ios::binary);
  file << "P5\n# Offset -108\n# Scale 0.003\n# Origin 90N 0E\n4 3\n65535\n";
  const auto sample = static_cast<std::uint16_t>(std::lround((height_m + 108.0) / 0.003));
  for (int i = 0; i < 4 * 3; ++i) file << static_cast<char>(sample >> 8) << static_cast<char>(sample & 0xFF);
}

TEST(Geoid, LiftsTheSeaOntoTheEllipsoid) {
  const testing::TemporaryFolder folder;
  write_flat_geoid(folder.path() / "egm96-5.pgm", 30.0);
  const Geoid geoid({folder.path().string()});
  ASSERT_TRUE(geoid.is_installed());
  EXPECT_NEAR(*geoid.height_ellipsoid_m({-22.9, -43.1}, 700.0), 730.0, 0.01);
  EXPECT_EQ(geoid.height_ellipsoid_m({std::nan(""), 0.0}, 700.0), std::nullopt);
  EXPECT_EQ(geoid.height_ellipsoid_m({0.0, 0.0}, std::nan("")), std::nullopt);
}

TEST(Geoid, IsThatOfTheFirstFolderThatHasOne) {
  const testing::TemporaryFolder empty, fifteen, five;
  write_flat_geoid(fifteen.path() / "egm96-15.pgm", 15.0);
  write_flat_geoid(five.path() / "egm96-5.pgm", 5.0);
  const auto folders = [](const auto&... folder) {
    return std::vector<std::string>{folder.path().string()...};
  };
  EXPECT_FALSE(Geoid(folders(empty)).is_installed());
  EXPECT_EQ(Geoid(folders(empty)).height_ellipsoid_m({-22.9, -43.1}, 700.0), std::nullopt);
  EXPECT_NEAR(*Geoid(folders(empty, fifteen, five)).height_ellipsoid_m({}, 0.0), 15.0, 0.01);
  EXPECT_NEAR(*Geoid(folders(five, fifteen)).height_ellipsoid_m({}, 0.0), 5.0, 0.01);
}

/// What is cut off is not there: nothing is read later, when it would be missed.
TEST(Geoid, ThatIsDamagedCountsAsNone) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "egm96-5.pgm";
  write_flat_geoid(file, 30.0);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 3);
  EXPECT_FALSE(Geoid({folder.path().string()}).is_installed());
  std::ofstream(file) << "P5\n99999999 99999999\n65535\n";
  EXPECT_FALSE(Geoid({folder.path().string()}).is_installed());
}

TEST(Geoid, CompletesWhatIsKnownAboveTheSea) {
  const testing::TemporaryFolder folder;
  write_flat_geoid(folder.path() / "egm96-5.pgm", 30.0);
  std::vector<ObjectReport> objects(2);
  objects[0].height.msl_m = 700.0;
  Geoid({folder.path().string()}).complete(objects);
  EXPECT_NEAR(objects[0].height.ellipsoid_m.value(), 730.0, 0.01);
  EXPECT_EQ(objects[1].height.ellipsoid_m, std::nullopt);
}

}  // namespace
}  // namespace geoloc::io
