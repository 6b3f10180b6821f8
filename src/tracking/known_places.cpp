// SPDX-License-Identifier: Apache-2.0
#include "tracking/known_places.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tracking/joint_frame.hpp"

namespace geoloc {
namespace {

/// Looks of a shorter time share the noise of their frames.
constexpr Duration kKnownFor = std::chrono::milliseconds{500};

/// Share of the position's 1-sigma, wandering and ripple together, that comes within a time.
double wandered_since(VehicleTime then, VehicleTime now, const DriftConfig& drift) {
  const double ago_s = std::max(0.0, seconds(now - then));
  const auto comes = [&](double time_constant_s) { return 1.0 - std::exp(-2.0 * ago_s / time_constant_s); };
  return std::sqrt((1.0 - drift.ripple_share) * comes(drift.position_time_constant_s) +
                   drift.ripple_share * comes(drift.ripple_time_constant_s));
}

}  // namespace

void list_places(const TrackTable& tracks, const SharedErrorEstimate& errors, const DriftConfig& drift,
                 const LocatedFrame& frame, VehicleTime proven_at, std::vector<WatchedPlace>& places) {
  places.clear();
  if (errors.drift.size() == 0) return;
  const VehicleTime now = frame.view.vehicle.time;
  // By the newest drift node there is: the frame's own is not made yet.
  const NodeVector& newest = errors.drift.node(errors.drift.end() - 2).mean;
  const FrameShift shift = shift_by(
      errors.calibration, newest, frame.projector.config().ground_height_above_home_m + frame.view.lifted_m);
  for (const RestingObject& track : tracks) {
    WatchedPlace place{shift.shown(Eigen::Vector3d(track.position_in_enu)), 0.0, 0.0,
                       wandered_since(track.last_look, now, drift), false};
    place.is_known =
        track.is_confirmed() && now - track.sums_since > kKnownFor && track.sums_since <= proven_at;
    if (place.is_known) {
      place.sigma_m = std::sqrt(0.5 * track.own_covariance.topLeftCorner<2, 2>().trace());
      place.sigma_up_m = std::hypot(std::sqrt(track.own_covariance(2, 2)), drift.sigma_up_m);
    }
    places.push_back(place);
  }
}

}  // namespace geoloc
