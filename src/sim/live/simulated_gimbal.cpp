// SPDX-License-Identifier: Apache-2.0
#include "sim/live/simulated_gimbal.hpp"

#include <algorithm>
#include <cmath>

namespace geoloc::sim {
namespace {

constexpr double kHeldDirection_rad = 30.0 * kRadPerDeg;
constexpr double kSweepMiddle_rad = -65.0 * kRadPerDeg, kSweepAmplitude_rad = 25.0 * kRadPerDeg;
constexpr double kSweepPeriod_s = 12.0;
constexpr double kLag_s = 0.15, kFollowLag_s = 0.4;
constexpr double kMostYawFromNose_rad = 160.0 * kRadPerDeg;
constexpr double kLeastPitch_rad = -90.0 * kRadPerDeg, kMostPitch_rad = 20.0 * kRadPerDeg;
constexpr double kShake_rad = 0.1 * kRadPerDeg, kShakeTime_s = 0.5;
/// Without any, its angles would look like commands.
constexpr double kLeastShake_rad = 0.01 * kRadPerDeg;
/// As the autopilot's roll and pitch are off by on the straight legs of data/flights, and as long.
constexpr double kSensorDrift_rad = 0.04 * kRadPerDeg, kSensorDriftTime_s = 3.0;
constexpr double kSensorNoise_rad = 0.03 * kRadPerDeg;

Eigen::Vector3d normals(Random& random) {
  Eigen::Vector3d drawn;
  for (double& value : drawn) value = random.normal();
  return drawn;
}

/// First-order Gauss-Markov.
Eigen::Vector3d wandered(const Eigen::Vector3d& value, double sigma, double time_constant_s, double step_s,
                         Random& random) {
  const double kept = std::exp(-step_s / time_constant_s);
  return kept * value + std::sqrt(1.0 - kept * kept) * sigma * normals(random);
}

/// Turned by that about its own axes.
Eigen::Quaterniond turned(const Eigen::Quaterniond& attitude, const Eigen::Vector3d& by_rad) {
  const double angle_rad = by_rad.norm();
  if (!(angle_rad > 0.0)) return attitude;
  return (attitude * Eigen::AngleAxisd(angle_rad, by_rad / angle_rad)).normalized();
}

double lagged(double from, double change, double lag_s, double step_s) {
  return from + change * (1.0 - std::exp(-step_s / lag_s));
}

}  // namespace

SimulatedGimbal::SimulatedGimbal(const GimbalSettings& settings, std::uint64_t seed)
    : settings_(settings), random_(seed) {
  shake_rad_ = kShake_rad * normals(random_);
  sensor_drift_rad_ = kSensorDrift_rad * normals(random_);
}

GimbalMoment SimulatedGimbal::step(double time_s, double step_s, const EulerAngles& vehicle) {
  const EulerAngles wanted = set_point(time_s, vehicle.yaw_rad);
  follow(wanted, step_s, vehicle.yaw_rad);
  const double shake_sigma_rad = settings_.is_perfect ? kLeastShake_rad : kShake_rad;
  shake_rad_ = wandered(shake_rad_, shake_sigma_rad, kShakeTime_s, step_s, random_);
  sensor_drift_rad_ = wandered(sensor_drift_rad_, kSensorDrift_rad, kSensorDriftTime_s, step_s, random_);
  GimbalMoment moment;
  moment.ned_from_gimbal = turned(ned_from_body(*angles_), shake_rad_);
  const Eigen::Vector3d sensor_error_rad = sensor_drift_rad_ + kSensorNoise_rad * normals(random_);
  moment.ned_from_measured =
      settings_.is_perfect ? moment.ned_from_gimbal : turned(moment.ned_from_gimbal, sensor_error_rad);
  moment.ned_from_set_point = ned_from_body(wanted);
  return moment;
}

EulerAngles SimulatedGimbal::set_point(double time_s, double vehicle_yaw_rad) const {
  const double sweep_rad =
      kSweepMiddle_rad + kSweepAmplitude_rad * std::sin(2.0 * kPi * time_s / kSweepPeriod_s);
  const double pitch_rad = settings_.aim == GimbalAim::kNadir     ? -90.0 * kRadPerDeg
                           : settings_.aim == GimbalAim::kOblique ? -45.0 * kRadPerDeg
                                                                  : sweep_rad;
  return {0.0, pitch_rad, settings_.holds_direction ? kHeldDirection_rad : vehicle_yaw_rad};
}

void SimulatedGimbal::follow(const EulerAngles& wanted, double step_s, double vehicle_yaw_rad) {
  if (!angles_) angles_ = wanted;
  const double yaw_lag_s = settings_.holds_direction ? kLag_s : kFollowLag_s;
  angles_->pitch_rad =
      std::clamp(lagged(angles_->pitch_rad, wanted.pitch_rad - angles_->pitch_rad, kLag_s, step_s),
                 kLeastPitch_rad, kMostPitch_rad);
  const double yaw_rad =
      lagged(angles_->yaw_rad, wrap_to_pi(wanted.yaw_rad - angles_->yaw_rad), yaw_lag_s, step_s);
  const double from_nose_rad =
      std::clamp(wrap_to_pi(yaw_rad - vehicle_yaw_rad), -kMostYawFromNose_rad, kMostYawFromNose_rad);
  angles_->yaw_rad = vehicle_yaw_rad + from_nose_rad;
}

}  // namespace geoloc::sim
