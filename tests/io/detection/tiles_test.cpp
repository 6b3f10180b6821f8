// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/tiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <ostream>
#include <random>

#include "geoloc/io/detection/tiled_detector.hpp"

namespace geoloc::io {
namespace {

DetectionConfig grid(int columns, int rows, int overlap_px) {
  DetectionConfig config;
  config.tile_columns = columns;
  config.tile_rows = rows;
  config.tile_overlap_px = overlap_px;
  return config;
}

struct Grid {
  const char* name;
  ImageSize picture;
  int columns, rows, overlap_px;
};

void PrintTo(const Grid& grid, std::ostream* out) {
  *out << grid.name;
}

class Tiles : public ::testing::TestWithParam<Grid> {};

TEST_P(Tiles, HaveOneSizeLieInThePictureAndCoverIt) {
  const auto [name, picture, columns, rows, overlap_px] = GetParam();
  const auto tiles = tiles_of(picture, grid(columns, rows, overlap_px));
  cv::Mat seen = cv::Mat::zeros(picture.height_px, picture.width_px, CV_8U);
  for (const cv::Rect& tile : tiles) {
    EXPECT_EQ(tile.size(), tiles.front().size());
    ASSERT_EQ(tile & cv::Rect(0, 0, picture.width_px, picture.height_px), tile);
    seen(tile).setTo(1);
  }
  EXPECT_EQ(cv::countNonZero(seen), picture.width_px * picture.height_px);
}

TEST_P(Tiles, HoldWhateverIsNoLongerThanTheOverlapEntirely) {
  const auto [name, picture, columns, rows, overlap_px] = GetParam();
  const auto tiles = tiles_of(picture, grid(columns, rows, overlap_px));
  if (overlap_px == 0 || 2 * overlap_px > std::min(tiles.front().width, tiles.front().height)) GTEST_SKIP();
  std::mt19937 random{7};
  for (int i = 0; i < 2000; ++i) {
    const cv::Rect object(
        static_cast<int>(random() % static_cast<unsigned>(picture.width_px - overlap_px + 1)),
        static_cast<int>(random() % static_cast<unsigned>(picture.height_px - overlap_px + 1)), overlap_px,
        overlap_px);
    EXPECT_TRUE(std::any_of(tiles.begin(), tiles.end(),
                            [&](const cv::Rect& tile) { return (tile & object) == object; }));
  }
}

INSTANTIATE_TEST_SUITE_P(Grids, Tiles,
                         ::testing::Values(Grid{"Whole", {1280, 720}, 1, 1, 64},
                                           Grid{"Hd", {1280, 720}, 2, 2, 64},
                                           Grid{"FourK", {3840, 2160}, 3, 3, 96},
                                           Grid{"Odd", {1917, 1003}, 4, 3, 31},
                                           Grid{"NoOverlap", {1001, 700}, 3, 2, 0},
                                           Grid{"SmallerThanTheOverlap", {50, 40}, 3, 3, 200},
                                           Grid{"FewerPixelsThanTiles", {3, 1}, 32, 32, 64}),
                         [](const auto& instance) { return std::string{instance.param.name}; });

constexpr ImageSize kSmallPicture{200, 100};
const DetectionConfig kTwoTiles = grid(2, 1, 20);  // from 0 to 110 and from 90 to 200

std::vector<Detection> merged(const std::vector<Detection>& left, const std::vector<Detection>& right,
                              const std::vector<Detection>& whole) {
  const auto tiles = tiles_of(kSmallPicture, kTwoTiles);
  EXPECT_EQ(tiles[0], cv::Rect(0, 0, 110, 100));
  EXPECT_EQ(tiles[1], cv::Rect(90, 0, 110, 100));
  return merge_tiles({{tiles[0], left}, {tiles[1], right}}, whole, kSmallPicture, kTwoTiles);
}

TEST(MergedTiles, HaveAnObjectOfTheOverlapOnce) {
  const auto found = merged({{{92, 40, 14, 14}, 0.8, 0}}, {{{93, 41, 14, 14}, 0.9, 0}}, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].confidence, 0.9);
}

TEST(MergedTiles, HaveNothingThatASeamCutsOff) {
  const auto found = merged({{{100, 40, 10, 14}, 0.99, 0}}, {{{100, 40, 16, 14}, 0.6, 0}}, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].box.width, 16);
  EXPECT_TRUE(merged({{{95, 40, 15, 14}, 0.99, 0}}, {}, {}).empty());
  EXPECT_EQ(merged({{{0, 40, 15, 14}, 0.9, 0}}, {{{190, 86, 10, 14}, 0.8, 0}}, {}).size(), 2U)
      << "the picture's own edges are no seams";
}

TEST(MergedTiles, TakeLongObjectsFromTheWholeAndShortOnesFromATile) {
  const Detection by_whole{{10, 40, 60, 30}, 0.6, 0}, part{{12, 42, 18, 18}, 0.9, 0};
  const auto large = merged({part}, {}, {by_whole});
  ASSERT_EQ(large.size(), 1U);
  EXPECT_EQ(large[0].box.width, 60);
  const auto small = merged({{{10, 40, 12, 12}, 0.6, 0}}, {}, {{{9, 39, 14, 14}, 0.9, 0}});
  ASSERT_EQ(small.size(), 1U);
  EXPECT_EQ(small[0].box.width, 12);
  EXPECT_EQ(merged({}, {}, {{{9, 39, 14, 14}, 0.9, 0}}).size(), 1U) << "what only the whole shows stays";
}

TEST(MergedTiles, KeepClassesApartAndTheMostConfidentFirst) {
  const auto found =
      merged({{{92, 40, 14, 14}, 0.7, 0}}, {{{92, 40, 14, 14}, 0.9, 1}, {{150, 10, 9, 9}, 0.8, 0}}, {});
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_GE(found[i - 1].confidence, found[i].confidence);
}

/// Finds the white square if it is entirely in the given picture and not too small in it.
class SquareDetector final : public Detector {
 public:
  std::vector<Detection> detect(const cv::Mat& bgr) override {
    ++counts_.images;
    if (bgr.empty()) {
      ++counts_.unusable_images;
      return {};
    }
    std::vector<cv::Point> white;
    cv::Mat grey;
    cv::extractChannel(bgr, grey, 0);
    cv::findNonZero(grey, white);
    if (white.size() != 100 || bgr.cols > 1000) return {};
    return {{{static_cast<double>(white.front().x), static_cast<double>(white.front().y), 10, 10}, 0.9, 0}};
  }
  const std::vector<std::string>& class_names() const override { return names_; }
  DetectorCounts counts() const override { return counts_; }

 private:
  std::vector<std::string> names_{"square"};
  DetectorCounts counts_;
};

TEST(TiledDetector, FindsWhatVanishesInTheWholeOnceAndInItsPlaceWhereverItIs) {
  TiledDetector detector(std::make_unique<SquareDetector>(), grid(3, 2, 16));
  std::mt19937 random{11};
  for (int i = 0; i < 50; ++i) {
    cv::Mat picture = cv::Mat::zeros(600, 1200, CV_8UC3);
    const cv::Rect square(static_cast<int>(random() % 1190), static_cast<int>(random() % 590), 10, 10);
    picture(square).setTo(cv::Scalar::all(255));
    const auto found = detector.detect(picture);
    ASSERT_EQ(found.size(), 1U) << square;
    EXPECT_EQ(found[0].box.x, square.x);
    EXPECT_EQ(found[0].box.y, square.y);
  }
  EXPECT_EQ(detector.counts().images, 50U);
}

TEST(TiledDetector, CountsWhatIsNoPictureOnce) {
  TiledDetector detector(std::make_unique<SquareDetector>(), grid(3, 2, 16));
  EXPECT_TRUE(detector.detect({}).empty());
  EXPECT_EQ(detector.counts().images, 1U);
  EXPECT_EQ(detector.counts().unusable_images, 1U);
  EXPECT_EQ(detector.class_names().size(), 1U);
}

}  // namespace
}  // namespace geoloc::io
