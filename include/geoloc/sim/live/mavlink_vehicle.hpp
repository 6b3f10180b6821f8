// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/sim/live/flight_clock.hpp"
#include "geoloc/sim/live/recorded_streams.hpp"

namespace geoloc::sim {

/// Plays the telemetry of a recorded flight the way an autopilot would. Unasked it sends HEARTBEAT alone. It
/// answers MAV_CMD_SET_MESSAGE_INTERVAL, REQUEST_DATA_STREAM, MAV_CMD_REQUEST_MESSAGE and TIMESYNC, and
/// refuses other commands. Messages are the recorded ones, told again on this vehicle's own boot clock: at
/// the rate that was asked for, but not faster than recorded; a flight flown X times as fast has X times the
/// rate. While the flight clock waits, the pose stands still. No sockets, no clocks: bytes and times come in,
/// datagrams go out.
class MavlinkVehicle {
 public:
  static constexpr io::MavAddress kAddress{1, 1};

  /// The flight must outlive it. booted_at: when its boot clock read zero.
  MavlinkVehicle(const Flight& flight, HostTime booted_at);

  /// Takes in what came from the peer; answers are in the next take_due().
  void receive(const std::uint8_t* data, std::size_t size, HostTime now, const FlightClock& clock);

  /// All that is to be sent by now, a frame a datagram. To be called every few milliseconds.
  std::vector<Datagram> take_due(HostTime now, const FlightClock& clock);

  /// Power lost and back: silence while booting, then a new boot clock and nothing asked for.
  void reboot(HostTime now);

  bool was_asked_for_messages() const { return was_asked_; }
  std::uint64_t messages_sent() const { return messages_sent_; }

  /// What the vehicle's clock reads.
  Duration boot_clock(HostTime now) const { return now - booted_at_; }

 private:
  struct Stream {
    RecordedStream recorded;
    std::optional<Duration> interval;  ///< in the time of the flight; nullopt: not asked for
    HostTime next_due{};
    std::size_t next_message = 0;
  };
  struct Command {
    std::uint16_t id = 0;
    std::uint8_t component = 0;  ///< that is commanded; 0: all
    float parameter1 = 0.0F;
    float parameter2 = 0.0F;
  };

  void answer_command(const Command& command, io::MavAddress sender, HostTime now, const FlightClock& clock);
  void answer_timesync(const io::Frame& frame, HostTime now);
  std::uint8_t set_message_interval(float message_id, float interval_us, HostTime now,
                                    const FlightClock& clock);
  std::uint8_t send_once(float message_id, HostTime now, const FlightClock& clock);
  void set_data_stream(const io::Frame& frame, HostTime now, const FlightClock& clock);
  void start(Stream& stream, Duration interval, HostTime now, const FlightClock& clock);

  bool is_for_us(std::uint8_t system, std::uint8_t component) const;
  bool has_camera() const;
  void send_heartbeat(HostTime now, const FlightClock& clock);
  void play(Stream& stream, HostTime now, const FlightClock& clock);
  void repeat_latest(Stream& stream, HostTime now, const FlightClock& clock);
  void tell(const RecordedMessage& message, HostTime sent_at, double speed);
  void send(std::uint32_t message_id, const Payload& payload, std::uint8_t component = kAddress.component);
  Stream* find(float message_id);

  HostTime booted_at_;
  HostTime silent_until_{};
  HostTime next_heartbeat_;
  io::FrameParser parser_;
  std::vector<Stream> streams_;
  std::vector<Datagram> outgoing_;
  std::uint8_t sequence_ = 0;
  std::uint8_t camera_sequence_ = 0;
  std::uint64_t messages_sent_ = 0;
  bool was_asked_ = false;
};

}  // namespace geoloc::sim
