// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/mavlink_vehicle.hpp"

#include <all/mavlink.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace geoloc::sim {
namespace {

constexpr Duration kHeartbeatPeriod = std::chrono::seconds{1};
constexpr Duration kBootSilence = std::chrono::seconds{2};
constexpr double kSlowestInterval_us = 60e6;

/// The struct that the generator makes for a message, whose layout is the wire's; cut zeros are filled in.
template <typename Fields>
Fields fields_of(const io::Frame& frame) {
  Fields fields{};
  std::memcpy(&fields, frame.payload, std::min(frame.payload_size, sizeof fields));
  return fields;
}

template <typename Fields>
Payload payload_of(const Fields& fields) {
  Payload payload{};
  std::memcpy(payload.data(), &fields, sizeof fields);
  return payload;
}

/// The next time of something periodic; what was missed is not made up for.
HostTime next_after(HostTime due, Duration period, HostTime now) {
  return due + period > now ? due + period : now + period;
}

}  // namespace

MavlinkVehicle::MavlinkVehicle(const Flight& flight, HostTime booted_at)
    : booted_at_(booted_at), next_heartbeat_(booted_at) {
  for (RecordedStream& recorded : recorded_streams(flight)) {
    streams_.push_back({std::move(recorded), std::nullopt, {}, 0});
  }
}

bool MavlinkVehicle::has_camera() const {
  return std::any_of(streams_.begin(), streams_.end(),
                     [](const Stream& stream) { return stream.recorded.component_id == MAV_COMP_ID_CAMERA; });
}

bool MavlinkVehicle::is_for_us(std::uint8_t system, std::uint8_t component) const {
  return (system == 0 || system == kAddress.system) && (component == 0 || component == kAddress.component ||
                                                        (component == MAV_COMP_ID_CAMERA && has_camera()));
}

void MavlinkVehicle::receive(const std::uint8_t* data, std::size_t size, HostTime now,
                             const FlightClock& clock) {
  if (now < silent_until_) return;
  while (size > 0) {
    const std::size_t taken = parser_.append(data, size);
    data += taken;
    size -= taken;
    while (const auto frame = parser_.next()) {
      switch (frame->message_id) {
        case MAVLINK_MSG_ID_COMMAND_LONG: {
          const auto command = fields_of<mavlink_command_long_t>(*frame);
          if (!is_for_us(command.target_system, command.target_component)) break;
          answer_command({command.command, command.target_component, command.param1, command.param2},
                         frame->sender, now, clock);
          break;
        }
        case MAVLINK_MSG_ID_REQUEST_DATA_STREAM:
          set_data_stream(*frame, now, clock);
          break;
        case MAVLINK_MSG_ID_TIMESYNC:
          answer_timesync(*frame, now);
          break;
        default:
          break;
      }
    }
  }
}

std::vector<Datagram> MavlinkVehicle::take_due(HostTime now, const FlightClock& clock) {
  if (now < silent_until_) return {};
  if (now >= next_heartbeat_) {
    send_heartbeat(now, clock);
    next_heartbeat_ = next_after(next_heartbeat_, kHeartbeatPeriod, now);
  }
  for (Stream& stream : streams_) {
    if (!stream.interval) continue;
    if (clock.is_released()) play(stream, now, clock);
    if (!clock.is_flying(now)) repeat_latest(stream, now, clock);
  }
  return std::exchange(outgoing_, {});
}

void MavlinkVehicle::reboot(HostTime now) {
  booted_at_ = now;
  silent_until_ = next_heartbeat_ = now + kBootSilence;
  parser_ = {};
  sequence_ = 0;
  for (Stream& stream : streams_) stream.interval.reset();
  outgoing_.clear();
}

void MavlinkVehicle::answer_command(const Command& command, io::MavAddress sender, HostTime now,
                                    const FlightClock& clock) {
  std::uint8_t result = MAV_RESULT_UNSUPPORTED;
  if (command.id == MAV_CMD_SET_MESSAGE_INTERVAL) {
    result = set_message_interval(command.parameter1, command.parameter2, now, clock);
  } else if (command.id == MAV_CMD_REQUEST_MESSAGE) {
    result = send_once(command.parameter1, now, clock);
  }
  mavlink_command_ack_t answer{};
  answer.command = command.id;
  answer.result = result;
  answer.target_system = sender.system;
  answer.target_component = sender.component;
  const bool is_cameras = command.component == MAV_COMP_ID_CAMERA;
  send(MAVLINK_MSG_ID_COMMAND_ACK, payload_of(answer), is_cameras ? command.component : kAddress.component);
}

std::uint8_t MavlinkVehicle::set_message_interval(float message_id, float interval_us, HostTime now,
                                                  const FlightClock& clock) {
  Stream* const stream = find(message_id);
  if (stream == nullptr) return MAV_RESULT_DENIED;
  if (interval_us == -1.0F || interval_us == 0.0F) {  // off, or the default, which is off
    stream->interval.reset();
    return MAV_RESULT_ACCEPTED;
  }
  if (!(interval_us > 0.0F && interval_us <= kSlowestInterval_us)) return MAV_RESULT_DENIED;
  start(*stream, from_seconds(static_cast<double>(interval_us) * 1e-6), now, clock);
  return MAV_RESULT_ACCEPTED;
}

std::uint8_t MavlinkVehicle::send_once(float message_id, HostTime now, const FlightClock& clock) {
  const Stream* const stream = find(message_id);
  if (stream == nullptr) return MAV_RESULT_DENIED;
  const std::size_t latest = stream->recorded.latest(clock.flight_time(now));
  tell(stream->recorded.messages[latest], now, clock.is_flying(now) ? clock.speed() : 0.0);
  return MAV_RESULT_ACCEPTED;
}

void MavlinkVehicle::set_data_stream(const io::Frame& frame, HostTime now, const FlightClock& clock) {
  const auto request = fields_of<mavlink_request_data_stream_t>(frame);
  if (!is_for_us(request.target_system, request.target_component)) return;
  for (Stream& stream : streams_) {
    const bool is_meant = data_stream_of(stream.recorded.message_id) == request.req_stream_id ||
                          request.req_stream_id == MAV_DATA_STREAM_ALL;
    if (!is_meant) continue;
    if (request.start_stop == 0 || request.req_message_rate == 0) {
      stream.interval.reset();
    } else {
      start(stream, from_seconds(1.0 / request.req_message_rate), now, clock);
    }
  }
}

void MavlinkVehicle::start(Stream& stream, Duration interval, HostTime now, const FlightClock& clock) {
  stream.interval = interval;
  stream.next_due = now;
  const VehicleTime flight_time = clock.flight_time(now);
  stream.next_message = stream.recorded.latest(flight_time);
  // The latest is in the past: the first to be sent is the one after it.
  if (stream.recorded.messages[stream.next_message].sent_at <= flight_time) ++stream.next_message;
  was_asked_ = true;
}

void MavlinkVehicle::answer_timesync(const io::Frame& frame, HostTime now) {
  const auto request = fields_of<mavlink_timesync_t>(frame);
  if (request.tc1 != 0) return;  // an answer to someone
  mavlink_timesync_t answer{};
  answer.tc1 = boot_clock(now).count();
  answer.ts1 = request.ts1;
  send(MAVLINK_MSG_ID_TIMESYNC, payload_of(answer));
}

void MavlinkVehicle::send_heartbeat(HostTime now, const FlightClock& clock) {
  mavlink_heartbeat_t fields{};
  fields.type = MAV_TYPE_QUADROTOR;
  fields.autopilot = MAV_AUTOPILOT_ARDUPILOTMEGA;
  fields.system_status = MAV_STATE_ACTIVE;
  fields.mavlink_version = 3;
  Payload payload = payload_of(fields);
  if (const Stream* const recorded = find(MAVLINK_MSG_ID_HEARTBEAT)) {
    const std::size_t latest = recorded->recorded.latest(clock.flight_time(now));
    payload = retell(recorded->recorded.messages[latest].frame, {});
  }
  send(MAVLINK_MSG_ID_HEARTBEAT, payload);
  if (!has_camera()) return;
  mavlink_heartbeat_t camera{};
  camera.type = MAV_TYPE_CAMERA;
  camera.autopilot = MAV_AUTOPILOT_INVALID;
  camera.system_status = MAV_STATE_ACTIVE;
  camera.mavlink_version = 3;
  send(MAVLINK_MSG_ID_HEARTBEAT, payload_of(camera), MAV_COMP_ID_CAMERA);
}

/// Sends the recorded messages whose time has come, thinned out to those nearest to when one is due.
void MavlinkVehicle::play(Stream& stream, HostTime now, const FlightClock& clock) {
  const Duration interval = from_seconds(seconds(*stream.interval) / clock.speed());
  const Duration half_period = from_seconds(0.5 * seconds(stream.recorded.period) / clock.speed());
  const auto& messages = stream.recorded.messages;
  const VehicleTime flight_time = clock.flight_time(now);
  for (; stream.next_message < messages.size() && messages[stream.next_message].sent_at <= flight_time;
       ++stream.next_message) {
    const RecordedMessage& message = messages[stream.next_message];
    const HostTime sent_at = clock.host_time(message.sent_at);
    if (sent_at + half_period < stream.next_due) continue;
    tell(message, sent_at, clock.speed());
    stream.next_due = std::max(stream.next_due + interval, sent_at);
  }
}

/// Before and after the flight the vehicle stands still and says so.
void MavlinkVehicle::repeat_latest(Stream& stream, HostTime now, const FlightClock& clock) {
  if (now < stream.next_due) return;
  const std::size_t latest = stream.recorded.latest(clock.flight_time(now));
  tell(stream.recorded.messages[latest], now, 0.0);
  const double period_s = std::max(seconds(*stream.interval), seconds(stream.recorded.period));
  stream.next_due = next_after(stream.next_due, from_seconds(period_s / clock.speed()), now);
}

void MavlinkVehicle::tell(const RecordedMessage& message, HostTime sent_at, double speed) {
  const Retelling how{boot_clock(sent_at), message.sent_at.time_since_epoch(), sent_at, speed};
  send(message.frame.message_id, retell(message.frame, how), message.frame.component_id);
}

void MavlinkVehicle::send(std::uint32_t message_id, const Payload& payload, std::uint8_t component) {
  std::uint8_t& sequence = component == kAddress.component ? sequence_ : camera_sequence_;
  Datagram datagram = encode_frame(message_id, {kAddress.system, component}, sequence, payload);
  if (datagram.empty()) return;  // recorded_streams() leaves such messages out
  ++sequence;
  outgoing_.push_back(std::move(datagram));
  ++messages_sent_;
}

MavlinkVehicle::Stream* MavlinkVehicle::find(float message_id) {
  const auto is_it = [message_id](const Stream& stream) {
    return static_cast<float>(stream.recorded.message_id) == message_id;
  };
  const auto found = std::find_if(streams_.begin(), streams_.end(), is_it);
  return found == streams_.end() ? nullptr : &*found;
}

}  // namespace geoloc::sim
