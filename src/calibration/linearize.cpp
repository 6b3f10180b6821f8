// SPDX-License-Identifier: Apache-2.0
#include "calibration/linearize.hpp"

#include <Eigen/Geometry>

namespace geoloc {
namespace {

Eigen::Matrix3d cross_product_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

}  // namespace

FixJacobians jacobians_of(const GroundFix& fix, const FrameView& view, double height_above_ground_m) {
  using Index = CalibrationIndex;
  const Eigen::Vector3d& v = fix.direction_in_enu;
  // Eq. 10: z = o + (h / -v_z) v, for a direction of any length.
  Eigen::Matrix<double, 2, 3> ground_from_direction;
  ground_from_direction << Eigen::Matrix2d::Identity(), -v.head<2>() / v.z();
  ground_from_direction *= height_above_ground_m / -v.z();
  const Eigen::Vector2d ground_from_height = -v.head<2>() / v.z();
  const Eigen::Matrix<double, 2, 3> ground_from_turn = -ground_from_direction * cross_product_matrix(v);

  FixJacobians jacobians;
  // The camera turned by t about its own axes sees along R (r + t x r) = v - [v] R t.
  jacobians.calibration.middleCols<3>(Index::kBoresight) =
      ground_from_turn * view.enu_from_camera.rotation.toRotationMatrix();
  // A later exposure shows the vehicle farther back: minus the ground's velocity along the ray.
  const Eigen::Vector3d& velocity = view.vehicle.velocity_in_enu;
  jacobians.calibration.col(Index::kLatency) =
      -velocity.head<2>() - ground_from_height * velocity.z() - ground_from_turn * view.turn.rate_in_enu;
  jacobians.calibration.col(Index::kPositionLag) = velocity.head<2>() + ground_from_height * velocity.z();
  jacobians.calibration.col(Index::kHeight) = ground_from_height;
  // A longer focal length draws every ray to the optical axis a: R (x, y, 1) becomes R (x, y, 1 + e), which
  // is v + e (v . a) a for a direction of any length.
  const Eigen::Vector3d axis = view.enu_from_camera.rotation * Eigen::Vector3d::UnitZ();
  jacobians.calibration.col(Index::kFocal) = ground_from_direction * (v.dot(axis) * axis);
  jacobians.calibration.middleCols<2>(Index::kOffset).setIdentity();
  jacobians.height = ground_from_height;

  // Clockwise yaw turns the ray about the vertical: (e, n) -> (n, -e).
  const Eigen::Vector2d from_nadir = fix.range_m * v.head<2>();
  jacobians.node.leftCols<2>().setIdentity();
  jacobians.node.col(2) = ground_from_height;
  jacobians.node.col(3) = Eigen::Vector2d(from_nadir.y(), -from_nadir.x());
  return jacobians;
}

}  // namespace geoloc
