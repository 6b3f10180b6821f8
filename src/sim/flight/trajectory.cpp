// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace geoloc::sim {
namespace {

Rigid3d pose_in_frame(const TrueState& state, const LocalFrame& frame, double ground_height_msl_m) {
  const LocalPoint point = frame.to_local(state.position);
  const Eigen::AngleAxisd frame_from_true_north(point.convergence_rad, Eigen::Vector3d::UnitZ());
  return {(enu_from_ned() * frame_from_true_north * ned_from_body(state.attitude)).normalized(),
          {point.position_in_enu.x(), point.position_in_enu.y(), state.height_msl_m - ground_height_msl_m}};
}

}  // namespace

Trajectory::Trajectory(const std::vector<TrueState>& states, const Site& site)
    : frame_(site.home, site.ground_height_msl_m) {
  if (states.size() < 2) throw std::invalid_argument("a trajectory needs two samples at least");
  times_.reserve(states.size());
  enu_from_body_.reserve(states.size());
  for (const TrueState& state : states) {
    const bool rises = times_.empty() || state.time > times_.back();
    if (!rises) throw std::invalid_argument("the times of a trajectory must rise");
    const Rigid3d pose = pose_in_frame(state, frame_, site.ground_height_msl_m);
    if (!is_valid(state.position) || !pose.translation.allFinite() || !pose.rotation.coeffs().allFinite()) {
      throw std::invalid_argument("a trajectory needs finite values and valid coordinates");
    }
    times_.push_back(state.time);
    enu_from_body_.push_back(pose);
  }
  survey_ = find_survey();
}

std::optional<Rigid3d> Trajectory::pose(VehicleTime time) const {
  if (time < times_.front() || time > times_.back()) return std::nullopt;
  const auto after = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
  const auto index = static_cast<std::size_t>(after - times_.begin());
  const Rigid3d& a = enu_from_body_[index - 1];
  const Rigid3d& b = enu_from_body_[index];
  const double fraction = seconds(time - times_[index - 1]) / seconds(times_[index] - times_[index - 1]);
  return Rigid3d{a.rotation.slerp(fraction, b.rotation),
                 a.translation + fraction * (b.translation - a.translation)};
}

TimeSpan Trajectory::find_survey() const {
  const auto lower = [](const Rigid3d& a, const Rigid3d& b) { return a.translation.z() < b.translation.z(); };
  const double greatest_m =
      std::max_element(enu_from_body_.begin(), enu_from_body_.end(), lower)->translation.z();
  const auto is_high = [&](const Rigid3d& pose) { return pose.translation.z() >= 0.95 * greatest_m; };
  const auto first = std::find_if(enu_from_body_.begin(), enu_from_body_.end(), is_high);
  const auto last = std::find_if(enu_from_body_.rbegin(), enu_from_body_.rend(), is_high);
  if (first == enu_from_body_.end()) return span();  // never above the ground
  return {times_[static_cast<std::size_t>(first - enu_from_body_.begin())],
          times_[static_cast<std::size_t>(enu_from_body_.rend() - last) - 1]};
}

Trajectory Trajectory::raised(double metres) const {
  Trajectory result = *this;
  for (Rigid3d& pose : result.enu_from_body_) pose.translation.z() += metres;
  return result;
}

Trajectory Trajectory::at_speed(double factor) const {
  const auto scaled = [factor](VehicleTime time) {
    return VehicleTime{from_seconds(seconds(time.time_since_epoch()) / factor)};
  };
  Trajectory result = *this;
  for (VehicleTime& time : result.times_) time = scaled(time);
  result.survey_ = {scaled(survey_.begin), scaled(survey_.end)};
  return result;
}

}  // namespace geoloc::sim
