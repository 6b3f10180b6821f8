// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/frame.hpp"
#include "geoloc/io/mavlink/messages.hpp"

namespace geoloc::io {

/// Which system of a link is the vehicle. An autopilot (component 1) whose HEARTBEAT was heard is asked for
/// its state, since many send none unasked; the one that sends state is the vehicle. As long as the one at
/// hand has not done so for kProof, it proves nothing: another one that does takes its place, and if nobody
/// does they have their turns. Then the choice stands, until the program ends.
class VehicleChoice {
 public:
  /// `system_id`: the only one that may be the vehicle; 0: any.
  explicit VehicleChoice(int system_id) : system_id_(system_id) {}

  /// Takes a frame of the link into account. True where its sender is the vehicle from now on, and was not
  /// before.
  bool observe(const Frame& frame, const Message& message, HostTime received_at);

  const std::optional<MavAddress>& vehicle() const { return vehicle_; }

  /// Whether the vehicle's heartbeats name ArduPilot.
  bool is_ardupilot() const { return is_by(Autopilot::kArduPilot); }

  /// Whether they name PX4.
  bool is_px4() const { return is_by(Autopilot::kPx4); }

  /// The system of another autopilot that was heard within the last seconds, be it allowed or not.
  std::optional<std::uint8_t> other_system(HostTime now) const;

 private:
  enum class Autopilot : std::uint8_t { kNone, kArduPilot, kPx4, kOther };

  bool is_by(Autopilot autopilot) const { return vehicle_ && autopilots_[vehicle_->system] == autopilot; }
  static Autopilot autopilot_of(const Heartbeat& heartbeat);
  bool may_replace(bool sends_state, HostTime now) const;
  void note_state(HostTime received_at);

  int system_id_;
  std::array<Autopilot, 256> autopilots_{};  // by system
  std::optional<MavAddress> vehicle_;
  HostTime chosen_at_{};
  std::optional<HostTime> state_since_;  // without a longer pause
  HostTime last_state_{};
  bool is_settled_ = false;
  std::uint8_t other_ = 0;
  std::optional<HostTime> other_heard_;
};

/// Whether a message says where the vehicle is or how it is turned.
bool is_state(const Message& message);

}  // namespace geoloc::io
