// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/vehicle_choice.hpp"

#include <algorithm>
#include <variant>

#include "mav_numbers.hpp"
#include "timing.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

/// For so long the vehicle must have sent state to stay the vehicle whatever comes.
constexpr Duration kProof = 3s;
/// After this silence it has to prove itself anew.
constexpr Duration kSilence = 3s;
/// How long an autopilot is remembered as one that is heard, too.
constexpr Duration kOtherLasts = 10s;

}  // namespace

bool is_state(const Message& message) {
  return std::holds_alternative<AttitudeMessage>(message) || std::holds_alternative<PositionSample>(message);
}

VehicleChoice::Autopilot VehicleChoice::autopilot_of(const Heartbeat& heartbeat) {
  if (heartbeat.is_from_ardupilot()) return Autopilot::kArduPilot;
  return heartbeat.is_from_px4() ? Autopilot::kPx4 : Autopilot::kOther;
}

bool VehicleChoice::observe(const Frame& frame, const Message& message, HostTime received_at) {
  if (frame.sender.component != kAutopilotComponent) return false;
  Autopilot& autopilot = autopilots_[frame.sender.system];
  const auto* const heartbeat = std::get_if<Heartbeat>(&message);
  if (heartbeat != nullptr && heartbeat->is_from_autopilot()) autopilot = autopilot_of(*heartbeat);
  if (autopilot == Autopilot::kNone) return false;
  const bool sends_state = is_state(message);
  if (vehicle_ == frame.sender) {
    if (sends_state) note_state(received_at);
    return false;
  }
  const bool is_allowed = system_id_ == 0 || system_id_ == frame.sender.system;
  if (is_allowed && (sends_state || heartbeat != nullptr) && may_replace(sends_state, received_at)) {
    vehicle_ = frame.sender;
    chosen_at_ = received_at;
    state_since_.reset();
    if (sends_state) note_state(received_at);
    return true;
  }
  other_ = frame.sender.system;
  other_heard_ = received_at;
  return false;
}

bool VehicleChoice::may_replace(bool sends_state, HostTime now) const {
  if (!vehicle_) return true;
  if (is_settled_) return false;
  if (sends_state) return !state_since_ || now - last_state_ > kSilence;
  return now - (state_since_ ? std::max(chosen_at_, last_state_) : chosen_at_) > kAutopilotsTurn;
}

void VehicleChoice::note_state(HostTime received_at) {
  if (!state_since_ || received_at - last_state_ > kSilence) state_since_ = received_at;
  last_state_ = received_at;
  is_settled_ = is_settled_ || last_state_ - *state_since_ >= kProof;
}

std::optional<std::uint8_t> VehicleChoice::other_system(HostTime now) const {
  if (!other_heard_ || now - *other_heard_ > kOtherLasts) return std::nullopt;
  return other_;
}

}  // namespace geoloc::io
