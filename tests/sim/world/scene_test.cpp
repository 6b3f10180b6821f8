// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/world/scene.hpp"

#include <gtest/gtest.h>

#include "appearance.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geoloc/sim/random.hpp"

namespace geoloc::sim {
namespace {

const Eigen::AlignedBox2d kArea(Eigen::Vector2d(-40, -30), Eigen::Vector2d(40, 30));

TEST(Distractors, KeepClearOfTargetsAndOfEachOther) {
  const std::vector<PlacedObject> targets(1);
  const auto distractors = make_distractors(200, kArea, targets, 7);
  EXPECT_GT(distractors.size(), 100u);
  for (std::size_t i = 0; i < distractors.size(); ++i) {
    EXPECT_NE(distractors[i].kind, ObjectKind::kFiducial);
    EXPECT_TRUE(kArea.contains(distractors[i].position_in_enu));
    EXPECT_GE(distractors[i].position_in_enu.norm(), 0.8 * std::sqrt(0.5));
    for (std::size_t j = 0; j < i; ++j) {
      const double gap_m = (distractors[i].position_in_enu - distractors[j].position_in_enu).norm();
      EXPECT_GE(gap_m, half_extent_m(distractors[i]).norm() + half_extent_m(distractors[j]).norm());
    }
  }
}

TEST(Distractors, FollowFromTheSeed) {
  const auto first = make_distractors(20, kArea, {}, 7), again = make_distractors(20, kArea, {}, 7);
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_EQ(first[i].position_in_enu, again[i].position_in_enu);
  EXPECT_NE(first[0].position_in_enu, make_distractors(20, kArea, {}, 8)[0].position_in_enu);
}

TEST(Distractors, StopWhereTheAreaIsFull) {
  const Eigen::AlignedBox2d small(Eigen::Vector2d(0, 0), Eigen::Vector2d(3, 3));
  EXPECT_LT(make_distractors(1000, small, {}, 1).size(), 100u);
  EXPECT_TRUE(make_distractors(-5, small, {}, 1).empty());
}

class Looks : public ::testing::TestWithParam<int> {};

TEST_P(Looks, StayWithinTheirExtentAndRange) {
  PlacedObject object;
  object.kind = static_cast<ObjectKind>(GetParam());
  object.size_m = 1.3;
  Random random(5);
  bool seen = false;
  for (int i = 0; i < 20000; ++i) {
    object.look = static_cast<std::uint32_t>(i / 1000);
    const Eigen::Vector2f at(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const Surface surface = surface_at(object, at);
    seen = seen || surface.coverage > 0.0f;
    const bool inside = (at.array().abs() <= half_extent_m(object).array()).all();
    EXPECT_TRUE(inside || surface.coverage == 0.0f) << at.transpose();
    EXPECT_GE(surface.coverage, 0.0f);
    EXPECT_LE(surface.coverage, 1.0f);
    EXPECT_GE(surface.reflectance.minCoeff(), 0.0f);
    EXPECT_LE(surface.reflectance.maxCoeff(), 1.0f);
  }
  EXPECT_TRUE(seen);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, Looks, ::testing::Range(0, static_cast<int>(ObjectKind::kBullseye) + 1));

TEST(Fiducial, LooksTheSameAfterHalfATurnOnly) {
  const PlacedObject target;
  const auto grey = [&](float forward, float right) {
    return surface_at(target, {forward, right}).reflectance.mean();
  };
  EXPECT_GT(grey(0.15f, 0.15f), 0.5f);
  EXPECT_GT(grey(-0.15f, -0.15f), 0.5f);
  EXPECT_LT(grey(0.15f, -0.15f), 0.3f);
  EXPECT_LT(grey(0.0f, 0.0f), 0.3f);
  EXPECT_GT(grey(0.38f, 0.38f), 0.5f);
}

TEST(ObjectAxes, PointForwardAlongTheHeading) {
  PlacedObject object;
  object.heading_rad = 0.5 * kPi;  // east
  EXPECT_TRUE((object_from_enu(object) * Eigen::Vector2d(1, 0)).isApprox(Eigen::Vector2d(1, 0)));
  EXPECT_TRUE(
      (object_from_enu(object) * Eigen::Vector2d(0, -1)).isApprox(Eigen::Vector2d(0, 1)));  // south is right
}

}  // namespace
}  // namespace geoloc::sim
