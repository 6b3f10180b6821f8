// SPDX-License-Identifier: Apache-2.0
#include "import/gimbal_mount.hpp"

#include <algorithm>
#include <chrono>

#include "geoloc/geometry/attitude.hpp"

namespace geoloc::apps {
namespace {

/// Samples farther away than this tell nothing of the moment.
constexpr Duration kFarthest = std::chrono::seconds{1};

/// The turn from the body or the gimbal to north, east, down; between two samples, on the shortest way.
template <typename Sample>
std::optional<Eigen::Quaterniond> turn_at(const std::vector<Sample>& samples, VehicleTime time) {
  const auto after =
      std::lower_bound(samples.begin(), samples.end(), time,
                       [](const Sample& sample, VehicleTime wanted) { return sample.time < wanted; });
  const bool has_after = after != samples.end() && after->time - time <= kFarthest;
  const bool has_before = after != samples.begin() && time - std::prev(after)->time <= kFarthest;
  if (!has_after && !has_before) return std::nullopt;
  if (!has_before) return ned_from_body(after->angles);
  const auto before = std::prev(after);
  if (!has_after) return ned_from_body(before->angles);
  const double share = seconds(time - before->time) / seconds(after->time - before->time);
  return ned_from_body(before->angles).slerp(share, ned_from_body(after->angles));
}

}  // namespace

std::optional<CameraMount> assumed_mount(const FlightTrack& track, const CameraMount& mount,
                                         VehicleTime time) {
  const auto ned_from_vehicle = turn_at(track.attitudes, time);
  const auto ned_from_gimbal = turn_at(track.assumed_gimbal, time);
  if (!ned_from_vehicle || !ned_from_gimbal) return std::nullopt;
  return mount.turned_to(ned_from_vehicle->conjugate() * *ned_from_gimbal);
}

CameraMount told_mount(const CameraMount& mount) {
  if (mount.kind == MountKind::kGimbal) return mount;
  CameraMount on_gimbal = CameraMount::on_gimbal();
  on_gimbal.x_m = mount.x_m;
  on_gimbal.y_m = mount.y_m;
  on_gimbal.z_m = mount.z_m;
  return on_gimbal;
}

}  // namespace geoloc::apps
