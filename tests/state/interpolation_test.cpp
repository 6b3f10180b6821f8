// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/interpolation.hpp"

#include <gtest/gtest.h>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

TEST(CircularInterpolation, TakesTheShortWayRound) {
  EXPECT_NEAR(interpolate_circular(359 * kRadPerDeg, 1 * kRadPerDeg, 0.5), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(interpolate_circular(179 * kRadPerDeg, -179 * kRadPerDeg, 0.5)), kPi, 1e-12);
}

TEST(CircularInterpolation, IsEquation5InClosedForm) {
  // tan of the mean direction of two unit vectors, weights 3/4 and 1/4, worked by hand for 0 and 90 degrees.
  EXPECT_NEAR(interpolate_circular(0.0, kPi / 2, 0.25), std::atan(1.0 / 3.0), 1e-15);
}

TEST(Slerp, TurnsAtConstantRate) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 3).normalized();
  const Eigen::Quaterniond before = ned_from_body({0.3, -0.4, 2.9});
  const double angle = 0.8;
  const Eigen::Quaterniond after = before * Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
  for (const double alpha : {0.0, 0.1, 0.5, 0.9, 1.0, 1.05}) {
    const Eigen::Quaterniond expected = before * Eigen::Quaterniond(Eigen::AngleAxisd(alpha * angle, axis));
    EXPECT_LT(Interpolator<Eigen::Quaterniond>::between(before, after, alpha).angularDistance(expected),
              1e-7);
  }
}

TEST(Slerp, AndCircularAnglesAgreeForSmallTurns) {
  const EulerAngles before{0.10, -0.05, 3.1}, after{0.12, -0.02, -3.1};
  const Eigen::Quaterniond circular = ned_from_body(Interpolator<EulerAngles>::between(before, after, 0.5));
  const Eigen::Quaterniond slerp =
      Interpolator<Eigen::Quaterniond>::between(ned_from_body(before), ned_from_body(after), 0.5);
  EXPECT_LT(circular.angularDistance(slerp), 1e-3);  // second order in the turn of 0.09 rad
}

}  // namespace
}  // namespace geoloc
