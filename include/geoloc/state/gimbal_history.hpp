// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/geometry/expected.hpp"
#include "geoloc/state/gimbal_yaw_watch.hpp"
#include "geoloc/state/samples.hpp"
#include "geoloc/state/set_point_watch.hpp"
#include "geoloc/state/state_buffer.hpp"
#include "geoloc/state/vehicle_state.hpp"
#include "geoloc/state/with_steps.hpp"

namespace geoloc {

/// The last samples of a gimbal, interpolated as the vehicle's are (the shortest rotation), and what is
/// noticed of them: a yaw that counts from elsewhere than it is told to, and angles that are no measurements.
/// Never allocates.
class GimbalHistory {
 public:
  explicit GimbalHistory(const StateConfig& config) : config_(config) {}

  /// In any order. `steps`: those of the vehicle's attitude then, by whose yaw gimbals know north.
  void add(const GimbalSample& sample, const StateSteps& steps);

  /// What the vehicle does: by the side of each sample of its own, and of each of the gimbal's in order.
  void note_vehicle(const EulerAngles& angles) { set_point_.note_vehicle(angles); }
  void compare(const GimbalSample& gimbal, double vehicle_yaw_rad) { yaw_.observe(gimbal, vehicle_yaw_rad); }

  /// At the time of the vehicle's state. NoState: why nothing is known; kNoGimbal: nothing has come.
  Expected<GimbalState, NoState> at(const VehicleState& vehicle) const;

  bool reaches_beyond(VehicleTime time) const { return samples_.reaches_beyond(time); }

  /// Forgets all samples; what was noticed of the gimbal stays.
  void restart();

  /// Whether the vehicle's turns show that yaws count from the other than what they are told to.
  bool is_yaw_told_wrong() const { return yaw_.is_told_wrong(); }
  /// What yaws that are told so are taken to count from.
  GimbalYaw reading(GimbalYaw told) const;
  /// Whether angles are those that the gimbal was told to hold: they count as wrong by half a degree, and
  /// more where it was told to turn. Nothing is known of it while it turns fast.
  bool is_set_point() const { return set_point_.is_set_point(); }
  /// The last sample that was not late.
  const std::optional<GimbalSample>& newest() const { return newest_; }

  const auto& counters() const { return samples_.counters(); }

 private:
  StateConfig config_;
  StateBuffer<WithSteps<GimbalSample>> samples_;
  std::optional<GimbalSample> newest_;
  GimbalYawWatch yaw_;
  SetPointWatch set_point_;
};

}  // namespace geoloc
