// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/state_provider.hpp"

#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/problems.hpp"
#include "settings/field_checker.hpp"
#include "state/state_fields.hpp"

namespace geoloc {
namespace {

/// One tangent plane serves this far: the turn of north is followed, and lengths are true to 5e-4.
constexpr double kFrameReach_m = 200e3;

bool is_finite(const EulerAngles& angles) {
  return std::isfinite(angles.roll_rad) && std::isfinite(angles.pitch_rad) && std::isfinite(angles.yaw_rad);
}

Eigen::Quaterniond interpolate_attitude(const Bracket<EulerAngles>& bracket, AttitudeInterpolation how) {
  if (how == AttitudeInterpolation::kCircular) return ned_from_body(bracket.interpolated());
  return Interpolator<Eigen::Quaterniond>::between(ned_from_body(bracket.before),
                                                   ned_from_body(bracket.after), bracket.alpha);
}

Eigen::Vector3d angular_velocity_in_body(const Bracket<EulerAngles>& bracket) {
  const Eigen::Quaterniond before_from_after =
      ned_from_body(bracket.before).conjugate() * ned_from_body(bracket.after);
  const Eigen::AngleAxisd turn(before_from_after);
  return wrap_to_pi(turn.angle()) / seconds(bracket.spacing) * turn.axis();
}

}  // namespace

std::vector<std::string> StateConfig::problems() const {
  return check_fields(*this);
}

StateProvider::StateProvider(const StateConfig& config) : config_(config) {
  throw_if_any(config.problems());
}

bool StateProvider::accept_stamp(VehicleTime stamp) {
  switch (boot_clock_.observe(stamp)) {
    case BootClockMonitor::Verdict::kAdvanced:
      return true;
    case BootClockMonitor::Verdict::kSuspect:
      ++counters_.suspect_stamps;
      return false;
    case BootClockMonitor::Verdict::kRebooted:
      restart();
      return true;
  }
  return false;
}

void StateProvider::restart() {
  ++counters_.reboots;
  forget_samples();
}

void StateProvider::on_clock_step() {
  ++counters_.clock_steps;
  forget_samples();
}

void StateProvider::forget_samples() {
  attitudes_.clear();
  positions_.clear();
  boot_clock_ = BootClockMonitor{};
}

void StateProvider::add(const AttitudeSample& sample) {
  if (!is_finite(sample.angles)) {
    ++counters_.invalid;
    return;
  }
  if (accept_stamp(sample.time)) attitudes_.insert(sample.time, sample.angles);
}

void StateProvider::add(const PositionSample& sample) {
  if (!is_valid(sample.position) || !std::isfinite(sample.height_above_home_m)) {
    ++counters_.invalid;
    return;
  }
  if (!accept_stamp(sample.time)) return;
  if (!frame_) {
    if (sample.height_msl_m && std::isfinite(*sample.height_msl_m))
      home_height_msl_m_ = *sample.height_msl_m - sample.height_above_home_m;
    frame_.emplace(sample.position, home_height_msl_m_.value_or(0.0));
  }
  const LocalPoint local = frame_->to_local(sample.position);
  if (!(local.position_in_enu.norm() < kFrameReach_m)) {
    ++counters_.too_far;
    return;
  }
  LocalPosition position;
  position.position_in_enu << local.position_in_enu, sample.height_above_home_m;
  position.convergence_rad = local.convergence_rad;
  if (positions_.insert(sample.time, position)) sigma_horizontal_m_ = sample.sigma_horizontal_m;
}

Expected<VehicleState, NoState> StateProvider::at(VehicleTime time) const {
  const Duration max_gap = from_seconds(config_.max_gap_s);
  const Duration max_extrapolation = from_seconds(config_.max_extrapolation_s);
  const auto position = positions_.bracket(time, max_gap, max_extrapolation);
  if (!position) return position.error();
  const auto attitude = attitudes_.bracket(time, max_gap, max_extrapolation);
  if (!attitude) return attitude.error();

  const LocalPosition here = position->interpolated();
  const Eigen::Quaterniond true_north_turn(Eigen::AngleAxisd(here.convergence_rad, Eigen::Vector3d::UnitZ()));
  VehicleState state;
  state.time = time;
  state.enu_from_body.rotation =
      (enu_from_ned() * true_north_turn * interpolate_attitude(*attitude, config_.attitude_interpolation))
          .normalized();
  state.enu_from_body.translation = here.position_in_enu;
  state.velocity_in_enu =
      (position->after.position_in_enu - position->before.position_in_enu) / seconds(position->spacing);
  state.angular_velocity_in_body = angular_velocity_in_body(*attitude);
  state.sigma_horizontal_m = sigma_horizontal_m_;
  return state;
}

StateProvider::Counters StateProvider::counters() const {
  Counters all = counters_;
  all.attitudes = attitudes_.counters().inserted;
  all.positions = positions_.counters().inserted;
  all.duplicates = attitudes_.counters().duplicates + positions_.counters().duplicates;
  all.stale = attitudes_.counters().stale + positions_.counters().stale;
  return all;
}

}  // namespace geoloc
