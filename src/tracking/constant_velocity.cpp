// SPDX-License-Identifier: Apache-2.0
#include "tracking/constant_velocity.hpp"

#include <Eigen/LU>

namespace geoloc {

ConstantVelocity ConstantVelocity::at(const Eigen::Vector2d& position,
                                      const Eigen::Matrix2d& position_covariance, double sigma_speed_mps) {
  ConstantVelocity state;
  state.mean << position, Eigen::Vector2d::Zero();
  state.covariance.setZero();
  state.covariance.topLeftCorner<2, 2>() = position_covariance;
  state.covariance.bottomRightCorner<2, 2>().diagonal().setConstant(sigma_speed_mps * sigma_speed_mps);
  return state;
}

void ConstantVelocity::predict(double time_s, double sigma_acceleration_mps2) {
  Eigen::Matrix4d transition = Eigen::Matrix4d::Identity();
  transition.topRightCorner<2, 2>().diagonal().setConstant(time_s);
  const double density = sigma_acceleration_mps2 * sigma_acceleration_mps2;  // [m^2/s^3]
  mean = transition * mean;
  covariance = transition * covariance * transition.transpose();
  covariance.topLeftCorner<2, 2>().diagonal().array() += density * time_s * time_s * time_s / 3.0;
  covariance.topRightCorner<2, 2>().diagonal().array() += density * time_s * time_s / 2.0;
  covariance.bottomLeftCorner<2, 2>().diagonal().array() += density * time_s * time_s / 2.0;
  covariance.bottomRightCorner<2, 2>().diagonal().array() += density * time_s;
}

ConstantVelocity::Gain ConstantVelocity::update(const Eigen::Vector2d& position,
                                                const Eigen::Matrix2d& measurement_covariance) {
  const Gain crossed = covariance.leftCols<2>();
  const Gain gain = crossed * (position_covariance() + measurement_covariance).inverse();
  Eigen::Matrix4d rest = Eigen::Matrix4d::Identity();
  rest.leftCols<2>() -= gain;
  mean += gain * (position - this->position());
  covariance = rest * covariance * rest.transpose() + gain * measurement_covariance * gain.transpose();
  return gain;
}

}  // namespace geoloc
