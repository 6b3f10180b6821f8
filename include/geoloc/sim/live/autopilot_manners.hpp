// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace geoloc::sim {

/// A message that is sent without being asked for.
struct UnaskedStream {
  std::uint32_t message_id = 0;
  double rate_hz = 0.0;
};

/// How an autopilot behaves on a link, beside the messages that it knows.
struct AutopilotManners {
  std::vector<UnaskedStream> unasked;
  double timesync_rate_hz = 0.0;    ///< of requests of its own
  bool begins_in_v1 = false;        ///< MAVLink 1 until it hears MAVLink 2
  bool knows_data_streams = true;   ///< obeys REQUEST_DATA_STREAM
  std::uint8_t refusal = 0;         ///< MAV_RESULT of a command about a message that it does not have
  std::uint8_t heartbeat_type = 0;  ///< MAV_AUTOPILOT
};

/// ArduPilot on a port of which nobody has asked for anything yet.
AutopilotManners ardupilot_manners();

/// PX4 on its link to an onboard computer (UDP port 14540 in its simulator): it sends at the rates of its
/// onboard mode, asks for the time ten times a second, and begins in MAVLink 1 as firmware before 1.16 does
/// by default.
AutopilotManners px4_onboard_manners();

/// PX4 on its link to a ground station (UDP port 14550): the rates of its normal mode, some of which are
/// lower than geoloc's.
AutopilotManners px4_ground_manners();

}  // namespace geoloc::sim
