// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geoloc/sim/flight/flight.hpp"
#include "geoloc/sim/flight/mavlink_frame.hpp"
#include "geoloc/sim/live/mavlink_encoder.hpp"

namespace geoloc::sim {

struct RecordedMessage {
  VehicleTime sent_at;  ///< on the clock of the flight's log
  FrameView frame;      ///< points into the flight's log
};

/// All messages of one type that the autopilot sent, in the order of time.
struct RecordedStream {
  std::uint32_t message_id = 0;
  std::uint8_t component_id = 1;  ///< that tells it: the autopilot, or the camera its field of view
  Duration period{};              ///< mean; zero for a single message
  std::vector<RecordedMessage> messages;

  /// The last one sent at or before a time, else the first.
  std::size_t latest(VehicleTime time) const;
};

/// What the autopilot itself said (its system, component 1), apart from answers and texts. The flight must
/// outlive it.
std::vector<RecordedStream> recorded_streams(const Flight& flight);

/// MAV_DATA_STREAM in which ArduPilot sends a message; nullopt for those of none.
std::optional<std::uint8_t> data_stream_of(std::uint32_t message_id);

/// A message's payload with the zeros that MAVLink 2 cut off.
Payload whole_payload(const FrameView& frame);

/// How a recorded message is told again.
struct Retelling {
  Duration boot_clock{};      ///< the vehicle's clock when the message is sent
  Duration recorded_clock{};  ///< the same when it was recorded
  HostTime utc;               ///< at the sending
  double speed = 1.0;         ///< of the flight against the recorded one; 0 while it waits
};

/// The payload with its times on the new clock and its velocities and turn rates scaled. Types that hold
/// neither are returned as they are.
Payload retell(const FrameView& recorded, const Retelling& how);

}  // namespace geoloc::sim
