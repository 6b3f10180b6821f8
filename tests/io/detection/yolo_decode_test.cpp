// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/yolo_decode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "io/detection/detection_fields.hpp"
#include "support/setting_bounds.hpp"

namespace geoloc::io {
namespace {

struct Candidate {
  float x, y, width, height;
  std::vector<float> scores;
};

/// The tensor [1, 4 + classes, candidates].
std::vector<float> tensor(const std::vector<Candidate>& candidates) {
  const std::size_t rows = 4 + candidates.front().scores.size();
  std::vector<float> values(rows * candidates.size());
  for (std::size_t j = 0; j < candidates.size(); ++j) {
    const Candidate& candidate = candidates[j];
    const float box[] = {candidate.x, candidate.y, candidate.width, candidate.height};
    for (std::size_t k = 0; k < rows; ++k)
      values[k * candidates.size() + j] = k < 4 ? box[k] : candidate.scores[k - 4];
  }
  return values;
}

OutputForm yolo11(int classes, int candidates) {
  return {OutputLayout::kYolo11, classes, candidates, 4 + classes, false};
}

constexpr ImageSize kPicture{640, 384};

/// The threshold that the scores below are chosen around, whatever the default is.
const DetectionConfig kThreshold04{0.4, 0.5, 300, 0};

DecodedBoxes decode(const std::vector<Candidate>& candidates, const DetectionConfig& config = kThreshold04,
                    ImageSize picture = kPicture) {
  const std::vector<float> values = tensor(candidates);
  const auto classes = static_cast<int>(candidates.front().scores.size());
  return decode_yolo({values.data(), yolo11(classes, static_cast<int>(candidates.size()))},
                     fit_letterbox(picture, kPicture), kPicture, picture, config);
}

TEST(YoloDecode, TurnsCentresIntoCornersOfThePicture) {
  const auto decoded =
      decode({{100, 50, 20, 10, {0.9F}}}, kThreshold04, {1280, 720});  // scale 1/2, bars of 12 px
  ASSERT_EQ(decoded.detections.size(), 1U);
  const Box& box = decoded.detections[0].box;
  EXPECT_NEAR(box.x, 180, 1e-4);
  EXPECT_NEAR(box.y, 66, 1e-4);
  EXPECT_NEAR(box.width, 40, 1e-4);
  EXPECT_NEAR(box.height, 20, 1e-4);
  EXPECT_NEAR(decoded.detections[0].confidence, 0.9, 1e-6);
}

TEST(YoloDecode, TakesTheBestClassAndTheThreshold) {
  const auto decoded =
      decode({{100, 50, 20, 10, {0.1F, 0.7F, 0.5F}}, {200, 50, 20, 10, {0.3F, 0.39F, 0.1F}}});
  ASSERT_EQ(decoded.detections.size(), 1U);
  EXPECT_EQ(decoded.detections[0].class_id, 1);
}

TEST(YoloDecode, SuppressesOverlapsWithinAClassOnly) {
  const auto decoded = decode({{100, 50, 20, 20, {0.6F, 0.0F}},
                               {102, 50, 20, 20, {0.9F, 0.0F}},
                               {103, 50, 20, 20, {0.0F, 0.8F}},
                               {140, 50, 20, 20, {0.5F, 0.0F}}});
  ASSERT_EQ(decoded.detections.size(), 3U);
  EXPECT_NEAR(decoded.detections[0].confidence, 0.9, 1e-6);  // most confident first
  EXPECT_EQ(decoded.detections[1].class_id, 1);
  EXPECT_NEAR(decoded.detections[2].confidence, 0.5, 1e-6);
}

TEST(YoloDecode, WhatStaysDoesNotOverlapAndWhateverTheOrderOfTheCandidatesItStays) {
  std::mt19937 random{3};
  std::uniform_real_distribution<float> place{60, 300};
  std::uniform_real_distribution<float> size{5, 60};
  std::uniform_real_distribution<float> score{0, 1};
  std::vector<Candidate> candidates;
  for (int i = 0; i < 400; ++i) {
    candidates.push_back(
        {place(random), place(random), size(random), size(random), {score(random), score(random)}});
  }
  DetectionConfig config = kThreshold04;
  config.max_detections = 1000;
  const auto kept = decode(candidates, config).detections;
  EXPECT_LT(kept.size(), candidates.size() - 10);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(kept[j].confidence, kept[i].confidence);
      if (kept[i].class_id != kept[j].class_id) continue;
      EXPECT_LE(intersection_over_union(kept[i].box, kept[j].box), config.nms_iou);
    }
  }
  std::shuffle(candidates.begin(), candidates.end(), random);
  const auto again = decode(candidates, config).detections;
  ASSERT_EQ(again.size(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(again[i].box.x, kept[i].box.x);
}

TEST(YoloDecode, CutsBoxesOffAtTheEdgeAndDropsThoseOutside) {
  const auto decoded =
      decode({{5, 380, 20, 20, {0.9F}}, {700, 50, 20, 20, {0.9F}}, {640, 384, 4, 4, {0.8F}}});
  ASSERT_EQ(decoded.detections.size(), 2U);
  EXPECT_EQ(decoded.detections[0].box.x, 0);
  EXPECT_EQ(decoded.detections[0].box.width, 15);
  EXPECT_EQ(decoded.detections[0].box.y + decoded.detections[0].box.height, 384);
  EXPECT_EQ(decoded.detections[1].box.width, 2);
  EXPECT_EQ(decoded.rejected, 0U);
}

TEST(YoloDecode, RejectsAndCountsWhatCannotBeABox) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const auto decoded = decode({{nan, 50, 20, 20, {0.9F}},
                               {100, 50, infinity, 20, {0.9F}},
                               {100, 50, 20, -1, {0.9F}},
                               {100, 50, 0, 20, {0.9F}},
                               {100, 50, 20, 20, {7.0F}},
                               {100, 50, 20, 20, {infinity}},
                               {100, 50, 20, 20, {nan}}});
  EXPECT_TRUE(decoded.detections.empty());
  EXPECT_EQ(decoded.rejected, 7U);
}

TEST(YoloDecode, RejectsACandidateWithAnyScoreThatIsNoNumber) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto decoded = decode({{100, 50, 20, 20, {nan, 0.9F, 0.1F}},
                               {200, 50, 20, 20, {0.9F, nan, 0.1F}},
                               {300, 50, 20, 20, {0.1F, 0.9F, nan}},
                               {400, 50, 20, 20, {0.1F, 0.2F, 0.9F}}});
  ASSERT_EQ(decoded.detections.size(), 1U);
  EXPECT_EQ(decoded.detections[0].class_id, 2);
  EXPECT_EQ(decoded.rejected, 3U);
}

TEST(YoloDecode, StatesTheSigmaOfCentresInPixelsOfThePicture) {
  const std::vector<float> values =
      tensor({{100, 50, 20, 5, {0.9F}}, {300, 50, 40, 40, {0.8F}}, {638, 50, 20, 20, {0.7F}}});
  constexpr ImageSize kPictureSize{1280, 720};
  const auto decode_with = [&](const std::optional<CentreSigma>& sigma) {
    return decode_yolo({values.data(), yolo11(1, 3)}, fit_letterbox(kPictureSize, kPicture), kPicture,
                       kPictureSize, kThreshold04, sigma)
        .detections;
  };
  const auto stated = decode_with(CentreSigma{0.3, 0.02});
  ASSERT_EQ(stated.size(), 3U);
  EXPECT_NEAR(stated[0].sigma_px, 2.0 * std::hypot(0.3, 0.02 * 10), 1e-6);  // the picture is halved
  EXPECT_NEAR(stated[1].sigma_px, 2.0 * std::hypot(0.3, 0.02 * 40), 1e-6);
  EXPECT_EQ(stated[2].sigma_px, 0.0) << "cut off by the picture's edge: its centre is another";
  for (const Detection& detection : decode_with({})) EXPECT_EQ(detection.sigma_px, 0.0);
  EXPECT_EQ(decode_with(CentreSigma{1e-12, 0.0})[0].sigma_px, kSmallestSigma_px);
  EXPECT_EQ(decode_with(CentreSigma{1e300, 1e300})[0].sigma_px, kLargestSigma_px);
}

TEST(YoloDecode, ANetworkGoneWrongGivesNoMoreThanTheLimit) {
  std::vector<Candidate> candidates;
  for (int i = 0; i < 20'000; ++i) {
    const int row = i / 640;
    candidates.push_back({static_cast<float>(i % 640), static_cast<float>(row), 1, 1, {0.9F}});
  }
  EXPECT_EQ(decode(candidates).detections.size(), 300U);
}

TEST(IntersectionOverUnion, OfKnownBoxes) {
  const Box box{10, 10, 20, 10};
  EXPECT_DOUBLE_EQ(intersection_over_union(box, box), 1.0);
  EXPECT_DOUBLE_EQ(intersection_over_union(box, {20, 10, 20, 10}), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(intersection_over_union(box, {30, 10, 20, 10}), 0.0);
}

TEST(DetectionConfig, TellsEveryFault) {
  EXPECT_TRUE(DetectionConfig{}.problems().empty());
  DetectionConfig config{std::numeric_limits<double>::quiet_NaN(), 0.0, 0, -1};
  EXPECT_EQ(config.problems().size(), 4U);
  config.input_width_px = 9000;  // too long, and alone
  config.tile_columns = 0;
  config.tile_rows = 33;
  config.tile_overlap_px = -1;
  EXPECT_EQ(config.problems().size(), 9U);
}

TEST(DetectionConfig, KeepsEveryBoundThatItsDescriptionNames) {
  EXPECT_GT(testing::expect_bounds_are_kept<DetectionConfig>(), 0U);
}

}  // namespace
}  // namespace geoloc::io
