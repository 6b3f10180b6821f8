// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/expected.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/state/state_buffer.hpp"
#include "geoloc/state/vehicle_state.hpp"

namespace geoloc {

/// How far a camera had zoomed in at one instant.
struct ZoomState {
  std::optional<Eigen::Vector2d> focal_px;  ///< [fx, fy]; nullopt: the calibration's, nothing has been told
  double sigma_share = 0.0;                 ///< 1-sigma of it, as a share of it
};

/// The last focal lengths that a camera told. Between two that are near, its zoom runs steadily. Before the
/// first, that holds, and after the last one, that: cameras may tell them when they change, and not
/// else. Never allocates.
class ZoomHistory {
 public:
  /// False where it was refused: there is one of that time, or it is older than all that are kept. In any
  /// order; the focal length [fx, fy] must be finite and positive.
  bool add(VehicleTime time, const Eigen::Vector2d& focal_px);

  /// NoState::kInAGap: the zoom changed unseen, at some time around this one.
  Expected<ZoomState, NoState> at(VehicleTime time) const;

  /// When the next one is due, at the latest, where they come regularly; `time` is worth waiting for until
  /// then. nullopt where at(time) will not change any more, or nobody knows when.
  std::optional<VehicleTime> due_after(VehicleTime time) const;

  /// Forgets when they were; the last one goes on.
  void restart();

  /// The number of samples taken in.
  std::uint64_t count() const { return samples_.counters().inserted; }

 private:
  StateBuffer<Eigen::Vector2d> samples_;
  std::optional<VehicleTime> newest_;
  Duration spacing_{};                   // between the newest two; zero: there is one
  std::optional<Eigen::Vector2d> last_;  // what the newest one told, from before a restart, too
};

}  // namespace geoloc
