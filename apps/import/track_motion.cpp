// SPDX-License-Identifier: Apache-2.0
#include "import/track_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "import/rounding.hpp"
#include "import/way.hpp"

namespace geoloc::apps {
namespace {

using namespace std::chrono_literals;

/// A vehicle that hovers is told at least so often.
constexpr Duration kLongestGap = 500ms;

/// By the positions half a second before and after each.
void take_differences(std::vector<PositionSample>& positions) {
  constexpr Duration kHalf = 500ms;
  std::size_t from = 0, to = 0;
  for (PositionSample& position : positions) {
    while (position.time - positions[from].time > kHalf) ++from;
    while (to + 1 < positions.size() && positions[to].time - position.time < kHalf) ++to;
    const Duration span = positions[to].time - positions[from].time;
    position.velocity_in_enu = Eigen::Vector3d::Zero();
    if (span > 0ns) position.velocity_in_enu = way(positions[from], positions[to]) / seconds(span);
  }
}

/// Straight between the velocities before and after; at the ends, the nearest.
Eigen::Vector3d velocity_at(const std::vector<io::LoggedVelocity>& told, VehicleTime time) {
  const auto after =
      std::lower_bound(told.begin(), told.end(), time,
                       [](const auto& sample, VehicleTime wanted) { return sample.time < wanted; });
  if (after == told.begin()) return told.front().velocity_in_enu;
  if (after == told.end()) return told.back().velocity_in_enu;
  const auto before = std::prev(after);
  const double share = seconds(time - before->time) / seconds(after->time - before->time);
  return before->velocity_in_enu + share * (after->velocity_in_enu - before->velocity_in_enu);
}

/// Whether `value` of the positions, a reference to a number of metres_per_unit, was rounded and is now
/// smoothed.
template <typename Value>
bool smooth(std::vector<PositionSample>& positions, double finest, double metres_per_unit,
            const Value& value) {
  std::vector<double> told, time_s;
  for (PositionSample& position : positions) {
    told.push_back(value(position));
    time_s.push_back(seconds(position.time - positions.front().time));
  }
  const double step = rounding_step(told, finest);
  if (!(step > 0.0)) return false;
  const double origin = told.front();  // metres from there are small numbers
  for (double& number : told) number = (number - origin) * metres_per_unit;
  const std::vector<double> smoothed = unrounded(time_s, told, step * metres_per_unit);
  for (std::size_t i = 0; i < positions.size(); ++i)
    value(positions[i]) = origin + smoothed[i] / metres_per_unit;
  return true;
}

}  // namespace

void take_velocities(const std::vector<io::LoggedVelocity>& told, std::vector<PositionSample>& positions) {
  if (told.empty()) return take_differences(positions);
  for (PositionSample& position : positions) position.velocity_in_enu = velocity_at(told, position.time);
}

std::vector<AttitudeSample> level_towards_course(const std::vector<PositionSample>& positions) {
  constexpr double kSlowest_mps = 0.5;
  std::vector<AttitudeSample> attitudes;
  attitudes.reserve(positions.size());
  std::optional<double> course_rad;
  for (const PositionSample& position : positions) {
    const Eigen::Vector3d& velocity = *position.velocity_in_enu;
    if (velocity.head<2>().norm() > kSlowest_mps) {
      const bool is_first = !course_rad;
      course_rad = std::atan2(velocity.x(), velocity.y());
      for (AttitudeSample& earlier : attitudes) {  // before it moved at all
        if (!is_first) break;
        earlier.angles.yaw_rad = *course_rad;
      }
    }
    attitudes.push_back({position.time, {0.0, 0.0, course_rad.value_or(0.0)}});
  }
  return attitudes;
}

void drop_held_positions(std::vector<PositionSample>& positions) {
  const auto holds = [](const PositionSample& kept, const PositionSample& next) {
    return next.position.latitude_deg == kept.position.latitude_deg &&
           next.position.longitude_deg == kept.position.longitude_deg &&
           next.height_above_home_m == kept.height_above_home_m && next.time - kept.time < kLongestGap;
  };
  std::vector<PositionSample> kept;
  for (const PositionSample& position : positions) {
    if (kept.empty() || !holds(kept.back(), position)) kept.push_back(position);
  }
  positions = std::move(kept);
}

void take_out_rounding(std::vector<PositionSample>& positions, std::vector<std::string>& notes) {
  constexpr double kFinest_deg = 1e-6, kFinest_m = 0.1;
  if (positions.empty()) return;
  const double east_m = kMetresPerDegree * std::cos(positions.front().position.latitude_deg * kRadPerDeg);
  const bool is_latitude_rounded =
      smooth(positions, kFinest_deg, kMetresPerDegree,
             [](PositionSample& position) -> double& { return position.position.latitude_deg; });
  const bool is_longitude_rounded =
      smooth(positions, kFinest_deg, east_m,
             [](PositionSample& position) -> double& { return position.position.longitude_deg; });
  smooth(positions, kFinest_m, 1.0,
         [](PositionSample& position) -> double& { return position.height_above_home_m; });
  if (is_latitude_rounded || is_longitude_rounded)
    notes.emplace_back(
        "the log rounds its coordinates: where the vehicle was within them is told by how it moved on");
}

}  // namespace geoloc::apps
