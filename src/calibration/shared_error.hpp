// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace geoloc {

/// What all looks of a frame are off by together, as one vector: calibration (without the offset, which
/// cancels between a look and a track that looks made), drift of the vehicle's state, noise of the frame.
/// All Jacobians by it are whitened: by its components in units in which their prior covariance is one.
struct SharedError {
  static constexpr int kCalibrationSize = 7;
  static constexpr int kCalibration = 0;  ///< boresight, latency, height, focal length, position's lag
  static constexpr int kDrift = 7;        ///< east, north, up, yaw
  static constexpr int kFrame = 11;       ///< east, north
  static constexpr int kTime = 13;        ///< of the frame's stamp
  static constexpr int kSize = 14;

  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using Row = Eigen::Matrix<double, 2, kSize>;
  using CalibrationMatrix = Eigen::Matrix<double, kCalibrationSize, kCalibrationSize>;
  /// The same for a point: east, north, up.
  using PointRow = Eigen::Matrix<double, 3, kSize>;
};

/// J J', column by column: two at a time in a register.
inline Eigen::Matrix2d squared(const SharedError::Row& J) {
  Eigen::Vector2d first = Eigen::Vector2d::Zero(), second = Eigen::Vector2d::Zero();
  for (int i = 0; i < SharedError::kSize; ++i) {
    first += J(0, i) * J.col(i);
    second += J(1, i) * J.col(i);
  }
  Eigen::Matrix2d square;
  square << first, second;
  return square;
}

}  // namespace geoloc
