// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "geoloc/geometry/rigid3.hpp"

namespace geoloc {

/// The errors that are constant over a flight, as one vector: the order of everything that is indexed by
/// them.
struct CalibrationIndex {
  static constexpr int kBoresight = 0;    ///< x, y, z of the camera [rad], camera axes
  static constexpr int kLatency = 3;      ///< [s]
  static constexpr int kHeight = 4;       ///< [m]
  static constexpr int kFocal = 5;        ///< natural logarithm of a ratio
  static constexpr int kPositionLag = 6;  ///< [s]
  static constexpr int kOffset = 7;       ///< east, north [m]
  static constexpr int kSize = 9;
};

using CalibrationVector = Eigen::Matrix<double, CalibrationIndex::kSize, 1>;
using CalibrationMatrix = Eigen::Matrix<double, CalibrationIndex::kSize, CalibrationIndex::kSize>;

/// What is known of the constant errors: true = reported, corrected by the mean.
///   boresight: the camera is turned by this against its nominal mount, about its own axes
///   latency:   a frame shows the world this much before its stamp
///   height:    the camera is this much higher above the ground plane than reported
///   focal:     the focal length is the nominal one times e to the power of this
///   position_lag: the reported position is that of the vehicle so much earlier, as seen against its attitude
///   offset:    the vehicle is this much east and north of where it reports to be
struct Calibration {
  CalibrationVector mean = CalibrationVector::Zero();
  CalibrationMatrix covariance = CalibrationMatrix::Zero();

  Eigen::Vector3d boresight_rad() const { return mean.segment<3>(CalibrationIndex::kBoresight); }
  double latency_s() const { return mean[CalibrationIndex::kLatency]; }
  double height_m() const { return mean[CalibrationIndex::kHeight]; }
  /// The focal length by the nominal one, and by how much it is longer [%].
  double focal_ratio() const { return std::exp(mean[CalibrationIndex::kFocal]); }
  double focal_percent() const { return 100.0 * std::expm1(mean[CalibrationIndex::kFocal]); }
  double position_lag_s() const { return mean[CalibrationIndex::kPositionLag]; }
  Eigen::Vector2d offset_m() const { return mean.segment<2>(CalibrationIndex::kOffset); }
  /// Turns a camera's nominal pose by the boresight.
  void turn(Rigid3d& enu_from_camera) const;

  double sigma(int index) const { return std::sqrt(covariance(index, index)); }
  /// Whether it is an unknown; it is none where the prior froze it.
  bool has_unknown_focal() const { return sigma_focal_percent() > 1e-5; }
  double sigma_focal_percent() const { return 100.0 * focal_ratio() * sigma(CalibrationIndex::kFocal); }
};

/// What is believed before the first frame. A component is frozen by a sigma (1-sigma) of 0.
struct CalibrationPrior {
  double boresight_x_deg = 0.0, boresight_y_deg = 0.0, boresight_z_deg = 0.0;
  double latency_s = 0.0;
  double height_m = 0.0;
  double focal_percent = 0.0;
  double position_lag_s = 0.0;
  double sigma_boresight_x_deg = 1.5;  ///< hand-mounted cameras are off by a degree or two
  double sigma_boresight_y_deg = 1.5;
  double sigma_boresight_z_deg = 3.0;  ///< and the compass is worse than the mount
  double sigma_latency_s = 0.3;
  double sigma_height_m = 2.0;  ///< scale of a distribution with heavy tails: the take-off may lie elsewhere
  double sigma_focal_percent = 0.0;
  double sigma_position_lag_s =
      0.05;  ///< what an autopilot's filter is told of its receiver's delay is a guess

  std::vector<std::string> problems() const;
};

}  // namespace geoloc
