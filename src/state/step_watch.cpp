// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/step_watch.hpp"

#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "state/turning.hpp"

namespace geoloc {
namespace {

/// Multicopters and small wings accelerate by less than 7 m/s^2, and begin to turn with less than 900
/// deg/s^2. But a turn that begins and ends between two samples a third of a second and more apart takes no
/// more than 140 deg/s^2 in a real quadrotor's log, and 70 in those of data/flights.
constexpr StepLimits kHorizontal{1.0, 7.0, 7.0, 0.3, 0.005};
constexpr StepLimits kHeight{1.0, 7.0, 7.0, 0.2, 0.02};
constexpr StepLimits kYaw{6.0 * kRadPerDeg, 900.0 * kRadPerDeg, 150.0 * kRadPerDeg, 1.0 * kRadPerDeg, 0.02};
/// Yaw says nothing where the nose points up or down.
constexpr double kMostPitch_rad = 60.0 * kRadPerDeg;

constexpr int kUp = 2, kYawRow = 3;

using Rate = Eigen::Matrix<double, 1, 1>;

/// From rates about the body's axes.
std::optional<Rate> yaw_rate(const AttitudeSample& sample) {
  if (!tells_rates(sample)) return std::nullopt;
  const Eigen::Vector3d& rates = *sample.rates_in_body_radps;
  const double roll_rad = sample.angles.roll_rad;
  return Rate((std::sin(roll_rad) * rates.y() + std::cos(roll_rad) * rates.z()) /
              std::cos(sample.angles.pitch_rad));
}

}  // namespace

StepWatch::StepWatch() : horizontal_(kHorizontal), height_(kHeight), yaw_(kYaw) {}

std::optional<StateSteps> StepWatch::observe(VehicleTime time, const Eigen::Vector3d& position_in_enu,
                                             const std::optional<Eigen::Vector3d>& velocity_in_enu) {
  if (newest_position_ && time <= *newest_position_) return std::nullopt;
  newest_position_ = time;
  if (velocity_in_enu && velocity_in_enu->allFinite()) {
    horizontal_.observe(time, position_in_enu.head<2>(), Eigen::Vector2d(velocity_in_enu->head<2>()));
    height_.observe(time, position_in_enu.tail<1>(), Rate(velocity_in_enu->z()));
  } else {
    horizontal_.observe(time, position_in_enu.head<2>());
    height_.observe(time, position_in_enu.tail<1>());
  }
  return steps_of_position();
}

std::optional<StateSteps> StepWatch::observe(const AttitudeSample& sample) {
  if (newest_attitude_ && sample.time <= *newest_attitude_) return std::nullopt;
  newest_attitude_ = sample.time;
  if (std::abs(sample.angles.pitch_rad) < kMostPitch_rad) {
    yaw_rad_ += wrap_to_pi(sample.angles.yaw_rad - yaw_rad_);
    yaw_.observe(sample.time, Eigen::Matrix<double, 1, 1>(yaw_rad_), yaw_rate(sample));
  } else {
    yaw_.restart();
  }
  return steps_of_attitude();
}

StateSteps StepWatch::steps_of_position() const {
  StateSteps steps;
  steps.segment = horizontal_.steps().count + height_.steps().count;
  steps.size.head<2>() = horizontal_.steps().size;
  steps.size[kUp] = height_.steps().size.value();
  steps.variance.head<2>() = horizontal_.steps().variance;
  steps.variance[kUp] = height_.steps().variance.value();
  return steps;
}

StateSteps StepWatch::steps_of_attitude() const {
  StateSteps steps;
  steps.segment = yaw_.steps().count;
  steps.size[kYawRow] = yaw_.steps().size.value();
  steps.variance[kYawRow] = yaw_.steps().variance.value();
  return steps;
}

void StepWatch::restart() {
  horizontal_.restart();
  height_.restart();
  yaw_.restart();
  newest_position_.reset();
  newest_attitude_.reset();
}

}  // namespace geoloc
