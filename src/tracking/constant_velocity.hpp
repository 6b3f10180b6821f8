// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace geoloc {

/// An object that keeps its velocity but for white noise of its acceleration (Bar-Shalom, Li and Kirubarajan,
/// Estimation with Applications to Tracking and Navigation, 2001, section 6.2). Elements: position east,
/// north [m], velocity east, north [m/s].
struct ConstantVelocity {
  using Gain = Eigen::Matrix<double, 4, 2>;

  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();

  /// Seen once.
  static ConstantVelocity at(const Eigen::Vector2d& position, const Eigen::Matrix2d& position_covariance,
                             double sigma_speed_mps);

  /// time_s >= 0; sigma_acceleration: 1-sigma per axis of the mean acceleration over one second.
  void predict(double time_s, double sigma_acceleration_mps2);

  /// Kalman update by a measured position, in Joseph's form. Returns the gain.
  Gain update(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance);

  Eigen::Vector2d position() const { return mean.head<2>(); }
  Eigen::Vector2d velocity() const { return mean.tail<2>(); }
  Eigen::Matrix2d position_covariance() const { return covariance.topLeftCorner<2, 2>(); }
  Eigen::Matrix2d velocity_covariance() const { return covariance.bottomRightCorner<2, 2>(); }
};

}  // namespace geoloc
