// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/tracking/track.hpp"

namespace geoloc {

/// Squared Mahalanobis distance of a residual; covariance positive definite.
inline double mahalanobis_squared(const Eigen::Vector2d& residual, const Eigen::Matrix2d& covariance) {
  return residual.dot(covariance.inverse() * residual);
}
inline double mahalanobis_squared(const Eigen::Vector3d& residual, const Eigen::Matrix3d& covariance) {
  return residual.dot(covariance.inverse() * residual);
}

/// Probability density of a residual [1/m^2]; covariance positive definite.
inline double density(const Eigen::Vector2d& residual, const Eigen::Matrix2d& covariance) {
  return std::exp(-0.5 * mahalanobis_squared(residual, covariance)) /
         (2.0 * kPi * std::sqrt(covariance.determinant()));
}

/// Kalman update by a direct measurement of the position (paper, section 4.1), in Joseph's form, which keeps
/// the covariance symmetric and positive.
inline Gaussian2 kalman_update(const Gaussian2& prior, const Eigen::Vector2d& measurement,
                               const Eigen::Matrix2d& measurement_covariance) {
  const Eigen::Matrix2d innovation_covariance = prior.covariance + measurement_covariance;
  const Eigen::Matrix2d gain = prior.covariance * innovation_covariance.inverse();
  const Eigen::Matrix2d rest = Eigen::Matrix2d::Identity() - gain;
  return {prior.mean + gain * (measurement - prior.mean),
          rest * prior.covariance * rest.transpose() + gain * measurement_covariance * gain.transpose()};
}

}  // namespace geoloc
