// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc {

/// Watches whether a gimbal's yaw counts from where it says, by what it does while the vehicle turns. One
/// that turns by as much counts from north: gimbals follow the nose, and do not run ahead of it. One that
/// turns back by as much counts from the nose, and holds a direction. One that stays counts from the nose if
/// the gimbal follows, and from north if it holds a direction, which it says. Turns in which it does anything
/// else, because its operator turns it, say nothing.
class GimbalYawWatch {
 public:
  /// In order of time. vehicle_yaw_rad: the vehicle's own then, without what it has stepped by.
  void observe(const GimbalSample& gimbal, double vehicle_yaw_rad);

  /// What comes next does not go on from here; what was found stays.
  void restart() { last_.reset(); }

  /// Whether yaws count from the other than what they are told to count from.
  bool is_told_wrong() const { return is_told_wrong_; }

 private:
  struct Yaws {
    VehicleTime time;
    double vehicle_rad;
    double gimbal_rad;
  };
  /// From one moment to now, with all turns.
  struct Turn {
    VehicleTime begin;
    double vehicle_rad = 0.0;
    double gimbal_rad = 0.0;
  };

  void begin(const Yaws& now);
  void judge(const GimbalSample& gimbal);
  void vote(bool agrees, double turned_rad);

  std::optional<Yaws> last_;
  Turn turn_;                  // since the vehicle last went straight
  Turn second_;                // of about the last second
  double agreeing_rad_ = 0.0;  // turns of the vehicle in which the yaw was as told
  double contradicting_rad_ = 0.0;
  bool is_told_wrong_ = false;
};

}  // namespace geoloc
