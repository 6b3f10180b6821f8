// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/state_provider.hpp"

#include <algorithm>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "settings/field_checker.hpp"
#include "state/state_fields.hpp"
#include "state/turning.hpp"

namespace geoloc {
namespace {

/// One tangent plane serves this far: the turn of north is followed, and lengths are true to 5e-4.
constexpr double kFrameReach_m = 200e3;

/// Two positions agree where a vehicle may go from one to the other: at a jet's speed, and with the error of
/// a first fix.
constexpr double kFirstFixError_m = 100.0, kHighestSpeed_mps = 250.0, kEarthRadius_m = 6.371e6;

/// RMS of what straight lines between decimated samples of the flights in data/flights are off by, 1 to 5 Hz.
constexpr double kAcceleration_mps2 = 1.0;

/// A gimbal that was told to turn by more than this so short a time ago may not have come there yet.
constexpr Duration kSettling = std::chrono::milliseconds{1500};
constexpr double kStill_rad = 8.0 * kRadPerDeg;

StateSteps sum(const StateSteps& a, const StateSteps& b) {
  return {a.segment + b.segment, a.size + b.size, a.variance + b.variance};
}

/// A late sample has the steps of the ones around it; where these differ, it is of no use.
template <typename Sample, std::size_t N>
std::optional<StateSteps> steps_around(VehicleTime time, const StateBuffer<Sample, N>& buffer,
                                       const StateSteps& otherwise) {
  const auto around = buffer.bracket(time, Duration::max(), Duration::zero());
  if (!around) return otherwise;
  if (step_in(*around)) return std::nullopt;
  return around->before.steps;
}

/// From the middle of a round Earth.
Eigen::Vector3d direction(const Geodetic& point) {
  const double latitude_rad = point.latitude_deg * kRadPerDeg,
               longitude_rad = point.longitude_deg * kRadPerDeg;
  return {std::cos(latitude_rad) * std::cos(longitude_rad), std::cos(latitude_rad) * std::sin(longitude_rad),
          std::sin(latitude_rad)};
}

bool agree(const PositionSample& a, const PositionSample& b) {
  const double pause_s = std::abs(seconds(b.time - a.time));
  const double distance_m = kEarthRadius_m * (direction(b.position) - direction(a.position)).norm();
  return distance_m <= kFirstFixError_m + kHighestSpeed_mps * pause_s;
}

bool is_finite(const EulerAngles& angles) {
  return std::isfinite(angles.roll_rad) && std::isfinite(angles.pitch_rad) && std::isfinite(angles.yaw_rad);
}

/// Autopilots tell roll and yaw within a turn, to either side or not, and pitch within a quarter of one.
bool are_within_a_turn(const EulerAngles& angles) {
  constexpr double kRounding_rad = 1e-3, kTurn_rad = 2.0 * kPi + kRounding_rad;
  return std::abs(angles.roll_rad) <= kTurn_rad && std::abs(angles.yaw_rad) <= kTurn_rad &&
         std::abs(angles.pitch_rad) <= 0.5 * kPi + kRounding_rad;
}

/// But for what single precision rounds. False for NaN.
bool is_rotation(const Eigen::Quaterniond& q) {
  constexpr double kTolerance = 0.01;
  return std::abs(q.norm() - 1.0) <= kTolerance;
}

Eigen::Quaterniond interpolate_attitude(const EulerAngles& before, const EulerAngles& after, double alpha,
                                        AttitudeInterpolation how) {
  if (how == AttitudeInterpolation::kCircular)
    return ned_from_body(Interpolator<EulerAngles>::between(before, after, alpha));
  return Interpolator<Eigen::Quaterniond>::between(ned_from_body(before), ned_from_body(after), alpha);
}

}  // namespace

std::vector<std::string> StateConfig::problems() const {
  return check_fields(*this);
}

StateProvider::StateProvider(const StateConfig& config) : config_(config), gimbal_(config) {
  refuse_if_any(config.problems());
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
  gimbal_.restart();
  zoom_.restart();
  newest_gimbal_.reset();
  turn_rates_.restart();
  if (unconfirmed_) frame_.reset();
  unconfirmed_.reset();
  home_.restart();
  watch_.restart();
  anchor_ = steps();  // what the vehicle says of itself from now on is all there is
  boot_clock_ = BootClockMonitor{};
}

void StateProvider::add(const AttitudeSample& sample) {
  if (!is_finite(sample.angles)) {
    ++counters_.invalid;
    return;
  }
  if (!are_within_a_turn(sample.angles)) {
    ++counters_.out_of_range;
    return;
  }
  if (!accept_stamp(sample.time)) return;
  auto steps = watch_.observe(sample);
  if (!steps) steps = steps_around(sample.time, attitudes_, watch_.steps_of_attitude());
  if (!steps) {
    ++counters_.stale;
    return;
  }
  turn_rates_.observe(sample);
  if (attitudes_.insert(sample.time, {sample, *steps})) gimbal_.note_vehicle(sample.angles);
}

void StateProvider::add(const GimbalSample& sample) {
  if (!is_rotation(sample.level_from_gimbal)) {
    ++counters_.invalid;
    return;
  }
  if (!accept_stamp(sample.time)) return;
  const auto steps = steps_around(sample.time, attitudes_, watch_.steps_of_attitude());
  if (!steps) {
    ++counters_.stale;
    return;
  }
  if (newest_gimbal_) compare_with_vehicle(*newest_gimbal_);
  newest_gimbal_ = sample;
  gimbal_.add(sample, *steps);
}

/// Whatever comes of a camera, what is made of the vehicle's own samples is the same.
void StateProvider::add_focal_length(VehicleTime time, const Eigen::Vector2d& focal_px) {
  if (!boot_clock_.is_near_newest(time)) {
    ++counters_.suspect_stamps;
    return;
  }
  zoom_.add(time, focal_px);
}

/// One whose vehicle's attitude is not known yet is left out: there are enough of them.
void StateProvider::compare_with_vehicle(const GimbalSample& gimbal) {
  constexpr Duration kLongestGap = std::chrono::seconds{1};
  const auto attitude = attitudes_.bracket(gimbal.time, kLongestGap, Duration::zero());
  if (!attitude || step_in(*attitude)) return;
  const EulerAngles angles = Interpolator<EulerAngles>::between(
      attitude->before.value.angles, attitude->after.value.angles, attitude->alpha);
  gimbal_.compare(gimbal, angles.yaw_rad - attitude->before.steps.size[3]);
}

void StateProvider::add(const PositionSample& sample) {
  if (!is_valid(sample.position) || !std::isfinite(sample.height_above_home_m)) {
    ++counters_.invalid;
    return;
  }
  if (!accept_stamp(sample.time)) return;
  if (unconfirmed_ && sample.time != unconfirmed_->time) judge_beginning(sample);
  if (!frame_) begin_frame(sample);
  take(sample);
}

/// By the second position of a frame: does it agree with the first?
void StateProvider::judge_beginning(const PositionSample& second) {
  const bool is_confirmed = agree(*unconfirmed_, second);
  unconfirmed_.reset();
  if (is_confirmed) return;
  ++counters_.unconfirmed;
  frame_.reset();
  home_height_msl_m_.reset();
  positions_.clear();
  home_.restart();
  watch_.restart();
}

void StateProvider::begin_frame(const PositionSample& first) {
  unconfirmed_ = first;
  if (first.height_msl_m && std::isfinite(*first.height_msl_m))
    home_height_msl_m_ = *first.height_msl_m - first.height_above_home_m;
  frame_.emplace(first.position, home_height_msl_m_.value_or(0.0));
}

void StateProvider::keep_frame() {
  unconfirmed_.reset();
}

void StateProvider::take(const PositionSample& sample) {
  const LocalPoint local = frame_->to_local(sample.position);
  if (!(local.position_in_enu.norm() < kFrameReach_m)) {
    ++counters_.too_far;
    ++too_far_in_a_row_;
    position_use_ = PositionUse::kTooFar;
    return;
  }
  too_far_in_a_row_ = 0;
  position_use_ = unconfirmed_ ? PositionUse::kUnconfirmed : PositionUse::kTaken;
  LocalPosition position;
  position.position_in_enu << local.position_in_enu,
      home_.above_first_home_m(sample.time, sample.height_above_home_m, sample.height_msl_m);
  position.convergence_rad = local.convergence_rad;
  auto steps = watch_.observe(sample.time, position.position_in_enu, sample.velocity_in_enu);
  if (!steps) steps = steps_around(sample.time, positions_, watch_.steps_of_position());
  if (!steps) {
    ++counters_.stale;
    return;
  }
  if (positions_.insert(sample.time, {position, *steps})) sigma_horizontal_m_ = sample.sigma_horizontal_m;
}

Expected<StateProvider::Brackets, NoState> StateProvider::brackets(VehicleTime time) const {
  const Duration max_gap = from_seconds(config_.max_gap_s);
  const Duration max_extrapolation = from_seconds(config_.max_extrapolation_s);
  const auto position = positions_.bracket(time, max_gap, max_extrapolation);
  if (!position) return position.error();
  const auto attitude = attitudes_.bracket(time, max_gap, max_extrapolation);
  if (!attitude) return attitude.error();
  if (const auto step = step_in(*position)) return *step;
  if (const auto step = step_in(*attitude)) return *step;
  return Brackets{*position, *attitude};
}

Expected<VehicleState, NoState> StateProvider::at(VehicleTime time) const {
  const auto found = brackets(time);
  if (!found) return found.error();
  const auto& [position, attitude] = *found;
  const LocalPosition &place_before = position.before.value, &place_after = position.after.value;
  const EulerAngles &angles_before = attitude.before.value.angles,
                    &angles_after = attitude.after.value.angles;
  const LocalPosition here = Interpolator<LocalPosition>::between(place_before, place_after, position.alpha);

  VehicleState state;
  state.time = time;
  state.steps = sum(position.before.steps, attitude.before.steps);
  const Eigen::Vector4d stepped = state.steps.size - anchor_.size;
  const Eigen::AngleAxisd true_north_turn(here.convergence_rad, Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd turn_back(stepped[3], Eigen::Vector3d::UnitZ());
  state.enu_from_vehicle_ned = turn_back * enu_from_ned() * true_north_turn;
  state.enu_from_body.rotation =
      (state.enu_from_vehicle_ned *
       interpolate_attitude(angles_before, angles_after, attitude.alpha, config_.attitude_interpolation))
          .normalized();
  state.enu_from_body.translation = here.position_in_enu - stepped.head<3>();
  if (position.spacing > Duration::zero())
    state.velocity_in_enu =
        (place_after.position_in_enu - place_before.position_in_enu) / seconds(position.spacing);
  if (attitude.spacing > Duration::zero())
    state.angular_velocity_in_body =
        turn_rates_.between(attitude.before.value, attitude.after.value, attitude.alpha);
  state.sigma_position_m = position.sigma(kAcceleration_mps2);
  state.sigma_turn_rad = attitude.sigma(kAngularAcceleration_radps2);
  state.sigma_bend_rad = attitude.sigma(state.angular_velocity_in_body.norm() / kTurnChange_s);
  state.telemetry_gap = std::max(position.spacing, attitude.spacing);
  state.sigma_horizontal_m = sigma_horizontal_m_;
  return state;
}

Expected<GimbalState, NoState> StateProvider::gimbal_at(const VehicleState& vehicle) const {
  const auto now = gimbal_.at(vehicle);
  if (!now || !gimbal_.is_set_point()) return now;
  const auto vehicle_before = at(vehicle.time - kSettling);
  if (!vehicle_before) return now;
  const auto before = gimbal_.at(*vehicle_before);
  const bool is_still = before && now->enu_from_gimbal.angularDistance(before->enu_from_gimbal) <= kStill_rad;
  if (!is_still) return NoState::kInAGap;
  return now;
}

void StateProvider::anchor(VehicleTime time) {
  const auto found = brackets(time);
  if (found) anchor_ = sum(found->position.before.steps, found->attitude.before.steps);
}

StateSteps StateProvider::steps() const {
  return sum(watch_.steps_of_position(), watch_.steps_of_attitude());
}

StateProvider::Counters StateProvider::counters() const {
  Counters all = counters_;
  all.attitudes = attitudes_.counters().inserted;
  all.positions = positions_.counters().inserted;
  const auto& gimbals = gimbal_.counters();
  all.gimbals = gimbals.inserted;
  all.focal_lengths = zoom_.count();
  all.duplicates = attitudes_.counters().duplicates + positions_.counters().duplicates + gimbals.duplicates;
  all.stale += attitudes_.counters().stale + positions_.counters().stale + gimbals.stale;
  all.home_moves = home_.moves();
  all.position_steps = watch_.horizontal_steps();
  all.height_steps = watch_.height_steps();
  all.yaw_steps = watch_.yaw_steps();
  return all;
}

}  // namespace geoloc
