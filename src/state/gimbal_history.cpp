// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/gimbal_history.hpp"

#include <algorithm>
#include <cmath>

#include "state/turning.hpp"

namespace geoloc {
namespace {

/// What a gimbal's axes are off by from where they were told to be: tenths of degrees where they are told to
/// stay, and where they are told to turn, what they turn by within the lag of their motors.
constexpr double kSetPointSigma_rad = 0.5 * kRadPerDeg, kSetPointLag_s = 0.3;
/// What is off by more says nothing of where an object is.
constexpr double kMostSigma_rad = 2.0 * kRadPerDeg;

double set_point_sigma_rad(double turn_rate_radps) {
  return std::hypot(kSetPointSigma_rad, kSetPointLag_s * turn_rate_radps);
}

/// A direction turned by no more than about the vertical.
struct Heading {
  double yaw_rad = 0.0;  ///< clockwise
  double rate_radps = 0.0;
};

/// The heading of the nose in axes of east, north and up; zero where it points up or down.
Heading heading_of(const VehicleState& vehicle) {
  const Eigen::Vector3d nose =
      vehicle.enu_from_vehicle_ned.conjugate() * vehicle.enu_from_body.rotation * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d turn_rate = vehicle.enu_from_vehicle_ned.conjugate() *
                                    (vehicle.enu_from_body.rotation * vehicle.angular_velocity_in_body);
  const Eigen::Vector3d moves = turn_rate.cross(nose);
  const double level_squared = nose.head<2>().squaredNorm();
  constexpr double kVertical = 1e-6;
  if (level_squared < kVertical) return {};
  return {std::atan2(nose.y(), nose.x()), (nose.x() * moves.y() - nose.y() * moves.x()) / level_squared};
}

}  // namespace

void GimbalHistory::add(const GimbalSample& sample, const StateSteps& steps) {
  GimbalSample kept = sample;
  kept.level_from_gimbal.normalize();
  if (!samples_.insert(kept.time, {kept, steps})) return;
  if (newest_ && kept.time < newest_->time) return;
  newest_ = kept;
  set_point_.observe(kept.level_from_gimbal);
}

GimbalYaw GimbalHistory::reading(GimbalYaw told) const {
  switch (config_.gimbal_yaw) {
    case GimbalYawReading::kFromNose:
      return GimbalYaw::kFromNose;
    case GimbalYawReading::kFromNorth:
      return GimbalYaw::kFromNorth;
    case GimbalYawReading::kAsTold:
      break;
  }
  if (!is_yaw_told_wrong()) return told;
  return told == GimbalYaw::kFromNose ? GimbalYaw::kFromNorth : GimbalYaw::kFromNose;
}

Expected<GimbalState, NoState> GimbalHistory::at(const VehicleState& vehicle) const {
  const auto around = samples_.bracket(vehicle.time, from_seconds(config_.max_gap_s),
                                       from_seconds(config_.max_extrapolation_s));
  if (!around) return around.error() == NoState::kNoSamples ? NoState::kNoGimbal : around.error();
  if (const auto step = step_in(*around)) return *step;
  const GimbalSample &before = around->before.value, &after = around->after.value;
  if (before.yaw != after.yaw) return NoState::kInAGap;

  const bool is_from_nose = reading(before.yaw) == GimbalYaw::kFromNose;
  const Heading level = is_from_nose ? heading_of(vehicle) : Heading{};
  const Eigen::Quaterniond enu_from_level =
      vehicle.enu_from_vehicle_ned * Eigen::AngleAxisd(level.yaw_rad, Eigen::Vector3d::UnitZ());
  Eigen::Vector3d rate_in_level = level.rate_radps * Eigen::Vector3d::UnitZ();
  if (around->spacing > Duration::zero())
    rate_in_level += rotation_vector(after.level_from_gimbal * before.level_from_gimbal.conjugate()) /
                     seconds(around->spacing);

  GimbalState state;
  state.enu_from_gimbal =
      (enu_from_level * Interpolator<Eigen::Quaterniond>::between(before.level_from_gimbal,
                                                                  after.level_from_gimbal, around->alpha))
          .normalized();
  state.turn_rate_in_enu = enu_from_level * rate_in_level;
  const double feedback_sigma_rad = is_set_point() ? set_point_sigma_rad(rate_in_level.norm()) : 0.0;
  if (feedback_sigma_rad > kMostSigma_rad) return NoState::kInAGap;
  state.sigma_turn_rad = std::hypot(around->sigma(kAngularAcceleration_radps2),
                                    is_from_nose ? vehicle.sigma_turn_rad : 0.0, feedback_sigma_rad);
  state.sigma_bend_rad = std::max(around->sigma(state.turn_rate_in_enu.norm() / kTurnChange_s),
                                  is_from_nose ? vehicle.sigma_bend_rad : 0.0);
  state.gap = around->spacing;
  return state;
}

void GimbalHistory::restart() {
  samples_.clear();
  newest_.reset();
  yaw_.restart();
  set_point_.restart();
}

}  // namespace geoloc
