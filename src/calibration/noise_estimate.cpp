// SPDX-License-Identifier: Apache-2.0
#include "calibration/noise_estimate.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace geoloc {
namespace {

/// What is assumed at first counts for so many observations: a second or two of flight outvotes it.
constexpr double kAttitudeObservations = 2.0, kPositionObservations = 20.0, kPixelObservations = 200.0;
/// Observations to remember.
constexpr double kMemory = 2000.0;
/// One observation counts for no more than so many times the present value: false pairs are no noise.
constexpr double kMostPerObservation = 9.0;

using Unknowns = Eigen::Matrix<double, 5, 1>;  // turn of the camera, shift of the ground
using UnknownsMatrix = Eigen::Matrix<double, 5, 5>;
using Design = Eigen::Matrix<double, 2, 5>;

Design design_of(const Residual& residual) {
  Design design;
  design << residual.turn, Eigen::Matrix2d::Identity();
  return design;
}

}  // namespace

void NoiseEstimate::Component::observe(double square, double count) {
  if (!(count > 0.0)) return;
  squares_ += std::min(square, kMostPerObservation * count * value());
  count_ += count;
  if (count_ > kMemory) {
    squares_ *= 0.5;
    count_ *= 0.5;
  }
}

NoiseEstimate::NoiseEstimate(double sigma_attitude_rad)
    : attitude_(sigma_attitude_rad * sigma_attitude_rad, kAttitudeObservations),
      position_(1.0, kPositionObservations),
      pixel_(1.0, kPixelObservations) {}

void NoiseEstimate::add(const Residual& residual) {
  if (count_ < kMostLooks) residuals_[count_++] = residual;
}

void NoiseEstimate::learn_from_frame(double expected_position_variance_m2) {
  if (count_ == 0) return;
  const double attitude_variance = attitude_.value();
  const double position_variance = std::max(position_.value() * expected_position_variance_m2, 1e-12);
  Eigen::Matrix2d shift_covariance = position_variance * Eigen::Matrix2d::Identity();
  for (std::size_t i = 0; i < count_; ++i)
    shift_covariance += residuals_[i].shared_covariance / static_cast<double>(count_);

  UnknownsMatrix information = UnknownsMatrix::Zero();
  information.topLeftCorner<3, 3>().diagonal().setConstant(1.0 / attitude_variance);
  information.bottomRightCorner<2, 2>() = shift_covariance.inverse();
  Unknowns right_hand_side = Unknowns::Zero();
  for (std::size_t i = 0; i < count_; ++i) {
    const Design design = design_of(residuals_[i]);
    const Eigen::Matrix<double, 5, 2> weighted = design.transpose() * residuals_[i].own_covariance.inverse();
    information += weighted * design;
    right_hand_side += weighted * residuals_[i].value;
  }
  const UnknownsMatrix covariance = information.llt().solve(UnknownsMatrix::Identity());
  const Unknowns mean = covariance * right_hand_side;

  double pixel_square = 0.0, pixel_count = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Design design = design_of(residuals_[i]);
    const Eigen::Vector2d left = residuals_[i].value - design * mean;
    const Eigen::Matrix2d own_information = residuals_[i].own_covariance.inverse();
    pixel_square += left.dot(own_information * left);
    pixel_count += 2.0 - (own_information * (design * covariance * design.transpose())).trace();
  }
  const Eigen::Matrix2d gain = position_variance * shift_covariance.inverse();
  const Eigen::Vector2d position = gain * mean.tail<2>();
  const double position_count =
      (gain - gain * covariance.bottomRightCorner<2, 2>() * gain.transpose() / position_variance).trace();

  attitude_.observe(mean.head<3>().squaredNorm(),
                    3.0 - covariance.topLeftCorner<3, 3>().trace() / attitude_variance);
  position_.observe(position.squaredNorm() / std::max(expected_position_variance_m2, 1e-12), position_count);
  const double factor = pixel_.value();
  pixel_.observe(factor * pixel_square, pixel_count);
}

}  // namespace geoloc
