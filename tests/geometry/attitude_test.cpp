// SPDX-License-Identifier: Apache-2.0
#include "geoloc/geometry/attitude.hpp"

#include <gtest/gtest.h>

#include <random>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/rigid3.hpp"

namespace geoloc {
namespace {

TEST(Attitude, NedFromBodyIsTheTextbookMatrix) {
  const double phi = 0.3, theta = -0.2, psi = 2.1;
  const double cf = std::cos(phi), sf = std::sin(phi), ct = std::cos(theta), st = std::sin(theta);
  const double cp = std::cos(psi), sp = std::sin(psi);
  Eigen::Matrix3d textbook;  // Beard & McLain, Small Unmanned Aircraft, eq. 2.5, transposed
  textbook << ct * cp, sf * st * cp - cf * sp, cf * st * cp + sf * sp,  //
      ct * sp, sf * st * sp + cf * cp, cf * st * sp - sf * cp,          //
      -st, sf * ct, cf * ct;
  EXPECT_TRUE(ned_from_body({phi, theta, psi}).toRotationMatrix().isApprox(textbook, 1e-14));
}

TEST(Attitude, EastNorthUpNamesTheAxes) {
  const Eigen::Vector3d north{1, 0, 0}, east{0, 1, 0}, down{0, 0, 1};
  EXPECT_TRUE((enu_from_ned() * north).isApprox(Eigen::Vector3d(0, 1, 0)));
  EXPECT_TRUE((enu_from_ned() * east).isApprox(Eigen::Vector3d(1, 0, 0)));
  EXPECT_TRUE((enu_from_ned() * down).isApprox(Eigen::Vector3d(0, 0, -1)));
}

TEST(Attitude, EulerAnglesAreTheInverse) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> full(-kPi, kPi), half(-0.499 * kPi, 0.499 * kPi);
  for (int i = 0; i < 1000; ++i) {
    const EulerAngles angles{full(random), half(random), full(random)};
    const EulerAngles back = euler_angles(ned_from_body(angles));
    EXPECT_NEAR(wrap_to_pi(back.roll_rad - angles.roll_rad), 0.0, 1e-9);
    EXPECT_NEAR(back.pitch_rad, angles.pitch_rad, 1e-9);
    EXPECT_NEAR(wrap_to_pi(back.yaw_rad - angles.yaw_rad), 0.0, 1e-9);
  }
}

TEST(Attitude, EulerAnglesOfAVerticalNoseGiveTheSameRotation) {
  for (const double pitch : {-kPi / 2, kPi / 2}) {
    const Eigen::Quaterniond rotation = ned_from_body({0.4, pitch, 1.0});
    EXPECT_LT(rotation.angularDistance(ned_from_body(euler_angles(rotation))), 1e-7);
  }
}

/// Rounding may make the sine of the pitch greater than 1.
TEST(Attitude, EulerAnglesOfAVerticalNoseAreFiniteThoughTheRotationIsRounded) {
  for (const double pitch : {-kPi / 2, kPi / 2}) {
    const Eigen::Quaterniond exact = ned_from_body({0.0, pitch, 0.0});
    for (const double factor : {1.0 - 1e-15, 1.0, 1.0 + 1e-15}) {
      const EulerAngles angles = euler_angles(Eigen::Quaterniond(factor * exact.coeffs()));
      EXPECT_NEAR(angles.pitch_rad, pitch, 1e-6);
      EXPECT_NEAR(angles.yaw_rad, 0.0, 1e-6);
    }
  }
}

TEST(Rigid3, ComposesAndInverts) {
  const Rigid3d b_from_a{ned_from_body({0.1, 0.2, 0.3}), {1, 2, 3}};
  const Rigid3d c_from_b{ned_from_body({-1.0, 0.5, 2.0}), {-4, 5, 6}};
  const Eigen::Vector3d point_in_a{7, -8, 9};
  EXPECT_TRUE(((c_from_b * b_from_a) * point_in_a).isApprox(c_from_b * (b_from_a * point_in_a), 1e-12));
  EXPECT_TRUE((b_from_a.inverse() * (b_from_a * point_in_a)).isApprox(point_in_a, 1e-12));
}

}  // namespace
}  // namespace geoloc
