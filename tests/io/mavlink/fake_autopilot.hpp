// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "io/mavlink/collecting_sink.hpp"
#include "io/mavlink/test_frames.hpp"

namespace geoloc::io::testing {

/// An autopilot in simulated time: it sends HEARTBEAT unrequested, and the rest at the requested intervals.
class FakeAutopilot {
 public:
  struct Character {
    std::uint8_t autopilot = kArduPilot;
    std::optional<std::uint8_t> answer = 0;  ///< MAV_RESULT to interval requests; nullopt: none
    bool obeys_intervals = true;
    bool obeys_data_streams = false;
    bool answers_timesync = true;
    bool is_mute = false;  ///< switched off or out of reach: receives and sends nothing
  };

  struct Heard {
    HostTime at;
    MavAddress sender;
    bool is_v2 = false;
    std::uint32_t message_id = 0;
    std::uint32_t wanted_message_id = 0;  ///< of MAV_CMD_SET_MESSAGE_INTERVAL
    std::uint8_t data_stream = 0;         ///< of REQUEST_DATA_STREAM
    double wanted_rate_hz = 0.0;          ///< of either
    int vehicle_type = -1;                ///< of HEARTBEAT
  };

  explicit FakeAutopilot(HostTime booted_at) : booted_at_(booted_at), frames_({1, 1}) {}

  Character character;
  std::vector<Heard> heard;

  void reboot(HostTime now);
  void receive(const std::uint8_t* frame, std::size_t size, HostTime now);
  /// What it sends up to `now`.
  Bytes transmit(HostTime now);
  VehicleTime clock(HostTime now) const { return VehicleTime{now - booted_at_}; }

  std::vector<Heard> heard_of(std::uint32_t message_id) const;
  /// Interval requests for that message.
  std::vector<Heard> requests_for(std::uint32_t message_id) const;

 private:
  struct Stream {
    Duration period;
    HostTime next;
  };

  void obey_interval(const Heard& request);
  void obey_data_stream(const Heard& request);
  Bytes say(std::uint32_t message_id, HostTime now);

  HostTime booted_at_;
  FrameFactory frames_;
  std::map<std::uint32_t, Stream> streams_;
  HostTime next_heartbeat_{};
  Bytes answers_;
};

/// The rates are those that the configuration tells, on any link.
inline MavlinkConfig with_steady_rates() {
  MavlinkConfig config;
  config.fast_rate_hz = 0.0;
  return config;
}

/// A link and an autopilot in steps of 10 ms of simulated time: what the link sends arrives `delay` steps
/// later, what the autopilot sends at once.
class Session {
 public:
  static constexpr HostTime kStart{std::chrono::seconds{1'795'300'000}};

  explicit Session(const MavlinkConfig& config = with_steady_rates())
      : link(config), autopilot(kStart - std::chrono::seconds{100}) {}

  void run(Duration duration);

  HostTime now = kStart;
  VehicleLink link;
  FakeAutopilot autopilot;
  CollectingSink sink;
  int delay = 1;

 private:
  std::deque<std::vector<Bytes>> to_autopilot_;  // of the last steps
};

}  // namespace geoloc::io::testing
