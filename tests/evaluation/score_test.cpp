// SPDX-License-Identifier: Apache-2.0
#include "geoloc/evaluation/score.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace geoloc {
namespace {

TEST(Score, IsWhatAHandCountGives) {
  const std::vector<Eigen::Vector2d> targets{{0, 0}, {10, 0}, {20, 0}, {21, 0}, {50, 0}};
  const std::vector<Eigen::Vector2d> objects{{0.3, 0.4}, {10.3, 0.4}, {20.3, 0.4}, {80, 80}};
  const Score score = score_objects(objects, targets);
  EXPECT_EQ(score.found, 3);
  EXPECT_EQ(score.extra, 1);
  EXPECT_EQ(score.merged_pairs, 1);  // 21 beside 20; the lost target at 50 has no neighbour
  EXPECT_NEAR(score.rmse_m.value(), 0.5, 1e-12);
  EXPECT_NEAR(score.relative_rmse_m.value(), 0.0, 1e-12);  // all errors are one offset
  EXPECT_EQ(score.target_of_object, (std::vector<std::optional<std::size_t>>{0, 1, 2, std::nullopt}));
}

TEST(HeightScore, IsWithAndWithoutTheErrorThatAllShare) {
  const HeightScore score = score_heights({3.0, 4.0, 5.0, 6.0});
  EXPECT_NEAR(score.rmse_m, std::sqrt((9.0 + 16.0 + 25.0 + 36.0) / 4.0), 1e-12);
  EXPECT_NEAR(score.relative_rmse_m, std::sqrt((2.25 + 0.25 + 0.25 + 2.25) / 4.0), 1e-12);
  EXPECT_EQ(score_heights({-7.0}).rmse_m, 7.0);
  EXPECT_EQ(score_heights({-7.0}).relative_rmse_m, 0.0);
  EXPECT_EQ(score_heights({}).rmse_m, 0.0);
}

TEST(Score, OfNothingFoundHasNoErrors) {
  EXPECT_EQ(score_objects({}, {{0, 0}}).found, 0);
  EXPECT_EQ(score_objects({}, {{0, 0}}).nearest_m, std::nullopt);
  EXPECT_EQ(score_objects({{0, 0}}, {}).extra, 1);
  const Score far = score_objects({{0, 0}, {0, 9}}, {{0, 4}});
  EXPECT_EQ(far.found, 0);
  EXPECT_EQ(far.rmse_m, std::nullopt);
  EXPECT_EQ(far.relative_rmse_m, std::nullopt);
  EXPECT_EQ(far.nearest_m, 4.0);
}

}  // namespace
}  // namespace geoloc
