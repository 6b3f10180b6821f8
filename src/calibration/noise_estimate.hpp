// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace geoloc {

/// How a look differs from the object that it shows.
struct Residual {
  Eigen::Vector2d value;             ///< look minus object [m]
  Eigen::Matrix<double, 2, 3> turn;  ///< d value / d attitude, camera axes [m/rad]
  Eigen::Matrix2d own_covariance;  ///< detector's noise, and what is not known of the object by itself [m^2]
  Eigen::Matrix2d shared_covariance;  ///< by calibration, drift and stamp, as far as they are not known [m^2]
};

/// The noise of attitude, position and detector as the flight shows it. What the residuals of one frame have
/// in common tells that of attitude and position, which differ by how it grows with range and angle; what is
/// left tells the detector's. Variance components by their fixed-point equations (Harville 1977): with m the
/// estimate of a frame's error and P its covariance, var = sum m^2 / sum (1 - P / var).
class NoiseEstimate {
 public:
  /// 1-sigma of the attitude to begin with, per axis.
  explicit NoiseEstimate(double sigma_attitude_rad);

  double attitude_variance_rad2() const { return attitude_.value(); }
  /// Variance of the position's noise, against what is expected of the receiver's accuracy.
  double position_factor() const { return position_.value(); }
  /// Variance of the detector's noise, against what is stated or configured.
  double pixel_factor() const { return pixel_.value(); }

  /// A frame, look by look; further looks than there is room for tell little more.
  void begin_frame() { count_ = 0; }
  void add(const Residual& residual);

  /// expected_position_variance_m2: of the frame's position noise, per axis, where its factor is one.
  void learn_from_frame(double expected_position_variance_m2);

 private:
  static constexpr std::size_t kMostLooks = 12;

  /// One variance: what was assumed at first counts as some observations, and old ones are forgotten.
  class Component {
   public:
    Component(double assumed, double observations) : assumed_(assumed), prior_count_(observations) {}
    double value() const { return (prior_count_ * assumed_ + squares_) / (prior_count_ + count_); }
    void observe(double square, double count);

   private:
    double assumed_;
    double prior_count_;
    double squares_ = 0.0;
    double count_ = 0.0;
  };

  Component attitude_;
  Component position_;
  Component pixel_;
  std::array<Residual, kMostLooks> residuals_;
  std::size_t count_ = 0;
};

}  // namespace geoloc
