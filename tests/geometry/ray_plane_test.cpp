// SPDX-License-Identifier: Apache-2.0
#include "geoloc/geometry/ray_plane.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace geoloc {
namespace {

const Plane<double> kGround{Eigen::Vector3d::UnitZ(), 3.0};

TEST(RayPlane, MeetsThePlaneWhereItSays) {
  const Ray<double> ray{{1, 2, 23}, Eigen::Vector3d(3, 0, -4).normalized()};
  const auto range_m = intersect(ray, kGround);
  ASSERT_TRUE(range_m);
  EXPECT_NEAR(*range_m, 25.0, 1e-12);
  EXPECT_TRUE(ray.at(*range_m).isApprox(Eigen::Vector3d(16, 2, 3), 1e-12));
}

TEST(RayPlane, RefusesRaysThatNeverMeetIt) {
  EXPECT_FALSE(intersect(Ray<double>{{0, 0, 10}, {0, 0, 1}}, kGround));  // away
  EXPECT_FALSE(intersect(Ray<double>{{0, 0, 10}, {1, 0, 0}}, kGround));  // parallel
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(intersect(Ray<double>{{0, 0, nan}, {0, 0, -1}}, kGround));
  EXPECT_FALSE(intersect(Ray<double>{{0, 0, 10}, {nan, nan, nan}}, kGround));
}

}  // namespace
}  // namespace geoloc
