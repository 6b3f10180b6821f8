// SPDX-License-Identifier: Apache-2.0
#include "calibration/linearize.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/projection/projector.hpp"
#include "projection/camera_pose.hpp"

namespace geoloc {
namespace {

struct Regime {
  const char* name;
  double height_m;
  double camera_pitch_deg;
  EulerAngles attitude_deg;
  Eigen::Vector3d velocity_in_enu;
  Eigen::Vector3d turn_rate_deg;  ///< body
  Eigen::Vector2d pixel;
};

/// Where the drift's yaw stands.
constexpr int kYaw = 3;

/// The fix of a pixel when calibration and drift are as given: everything recomputed, nothing linear.
class ExactFix {
 public:
  explicit ExactFix(const Regime& regime) : regime_(regime) { mount_.pitch_deg = regime.camera_pitch_deg; }

  FrameView view(const CalibrationVector& calibration, const NodeVector& drift) const {
    const double t = -calibration[CalibrationIndex::kLatency];
    const EulerAngles& a = regime_.attitude_deg;
    const Eigen::Vector3d rate = regime_.turn_rate_deg * kRadPerDeg;
    Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
    if (rate.norm() > 0) turned = Eigen::AngleAxisd(rate.norm() * t, rate.normalized());
    const Eigen::Quaterniond true_north(Eigen::AngleAxisd(drift[kYaw], Eigen::Vector3d::UnitZ()));
    FrameView view;
    view.vehicle.enu_from_body.rotation =
        enu_from_ned() * true_north *
        ned_from_body({a.roll_rad * kRadPerDeg, a.pitch_rad * kRadPerDeg, a.yaw_rad * kRadPerDeg}) * turned;
    view.vehicle.enu_from_body.translation =
        Eigen::Vector3d(5, -3, regime_.height_m) + t * regime_.velocity_in_enu;
    view.vehicle.enu_from_body.translation += drift.head<3>();
    view.vehicle.enu_from_body.translation +=
        calibration[CalibrationIndex::kPositionLag] * regime_.velocity_in_enu;
    view.vehicle.enu_from_body.translation.head<2>() += calibration.segment<2>(CalibrationIndex::kOffset);
    view.vehicle.velocity_in_enu = regime_.velocity_in_enu;
    view.turn.rate_in_enu = view.vehicle.enu_from_body.rotation * rate;
    view.enu_from_camera = enu_from_camera(view.vehicle, mount_, CameraOrientation::kComposed);
    Calibration{calibration, CalibrationMatrix::Zero()}.turn(view.enu_from_camera);
    view.enu_from_camera.translation.z() += calibration[CalibrationIndex::kHeight];
    view.focal_ratio = std::exp(calibration[CalibrationIndex::kFocal]);
    return view;
  }

  GroundFix fix(const FrameView& view, double ground_m = 0.0) const {
    ProjectorConfig config;
    config.ground_height_above_home_m = ground_m;
    return *Projector(config, CameraIntrinsics{}).project(regime_.pixel, view);
  }

  Eigen::Vector2d position(const CalibrationVector& calibration, const NodeVector& drift) const {
    return fix(view(calibration, drift)).position_in_enu;
  }

 private:
  Regime regime_;
  CameraMount mount_;
};

class JacobianLaws : public ::testing::TestWithParam<Regime> {};

TEST_P(JacobianLaws, AreTheNumericDerivatives) {
  const ExactFix exact(GetParam());
  CalibrationVector calibration = CalibrationVector::Zero();
  calibration[CalibrationIndex::kFocal] = std::log(0.95);
  const NodeVector drift = NodeVector::Zero();
  const FrameView view = exact.view(calibration, drift);
  const FixJacobians jacobians = jacobians_of(exact.fix(view), view, view.enu_from_camera.translation.z());
  constexpr double kStep = 1e-6;
  for (int i = 0; i < CalibrationIndex::kSize; ++i) {
    const CalibrationVector moved = kStep * CalibrationVector::Unit(i);
    const Eigen::Vector2d slope =
        (exact.position(calibration + moved, drift) - exact.position(calibration - moved, drift)) /
        (2 * kStep);
    EXPECT_LT((slope - jacobians.calibration.col(i)).norm(), 1e-5 * (1.0 + slope.norm()))
        << "calibration " << i;
  }
  for (int i = 0; i < kNodeSize; ++i) {
    const NodeVector moved = kStep * NodeVector::Unit(i);
    const Eigen::Vector2d slope =
        (exact.position(calibration, drift + moved) - exact.position(calibration, drift - moved)) /
        (2 * kStep);
    EXPECT_LT((slope - jacobians.node.col(i)).norm(), 1e-5 * (1.0 + slope.norm())) << "drift " << i;
  }
  // Deeper ground is a higher camera.
  const Eigen::Vector2d by_depth =
      (exact.fix(view, -kStep).position_in_enu - exact.fix(view, kStep).position_in_enu) / (2 * kStep);
  EXPECT_LT((by_depth - jacobians.height).norm(), 1e-5 * (1.0 + by_depth.norm()));
}

/// The ray by itself: where it meets the level that is a metre up.
TEST_P(JacobianLaws, AreStraightInTheHeight) {
  const ExactFix exact(GetParam());
  const FrameView view = exact.view(CalibrationVector::Zero(), NodeVector::Zero());
  const GroundFix fix = exact.fix(view);
  const FixJacobians jacobians = jacobians_of(fix, view, view.enu_from_camera.translation.z());
  for (const double up_m : {-5.0, 1.0, 8.0}) {
    const Eigen::Vector2d moved = exact.fix(view, up_m).position_in_enu - fix.position_in_enu;
    EXPECT_LT((moved + up_m * jacobians.height).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Regimes, JacobianLaws,
    ::testing::Values(Regime{"nadir", 20, -90, {0, 0, 40}, {3, 4, 0}, {0, 0, 0}, {639.5, 359.5}},
                      Regime{"corner", 20, -90, {8, -5, 250}, {-5, 1, 0.3}, {10, -20, 5}, {30, 700}},
                      Regime{"oblique", 60, -45, {5, 3, 120}, {10, -8, -1}, {0, 5, 0}, {900, 500}},
                      Regime{"grazing", 40, -25, {0, 0, 10}, {15, 0, 0}, {0, 0, 0}, {640, 500}},
                      Regime{"fast_turn", 25, -90, {30, 0, 0}, {0, 18, 2}, {40, 15, 60}, {200, 200}}),
    [](const auto& regime) { return std::string(regime.param.name); });

}  // namespace
}  // namespace geoloc
