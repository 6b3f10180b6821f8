// SPDX-License-Identifier: Apache-2.0
#include "io/mavlink/fake_autopilot.hpp"

#include <all/mavlink.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

namespace geoloc::io::testing {
namespace {

/// Parses with the generated parser: what geoloc sends must satisfy other programs.
mavlink_message_t parse(const std::uint8_t* frame, std::size_t size) {
  mavlink_message_t buffer{}, message{};
  mavlink_status_t state{}, status{};
  int complete = 0;
  for (std::size_t i = 0; i < size; ++i) {
    complete += mavlink_frame_char_buffer(&buffer, &state, frame[i], &message, &status) == MAVLINK_FRAMING_OK;
  }
  EXPECT_EQ(complete, 1) << "geoloc sent something that is not one MAVLink frame";
  return message;
}

Duration period_of(double rate_hz) {
  return from_seconds(1.0 / rate_hz);
}

}  // namespace

void FakeAutopilot::reboot(HostTime now) {
  booted_at_ = now;
  streams_.clear();
  answers_.clear();
}

void FakeAutopilot::receive(const std::uint8_t* frame, std::size_t size, HostTime now) {
  if (character.is_mute) return;
  const mavlink_message_t message = parse(frame, size);
  Heard heard_now;
  heard_now.at = now;
  heard_now.sender = {message.sysid, message.compid};
  heard_now.is_v2 = message.magic == MAVLINK_STX;
  heard_now.message_id = message.msgid;
  // The generated decoders copy the payload out of the packed struct; the getters would read it in place,
  // misaligned.
  if (message.msgid == MAVLINK_MSG_ID_HEARTBEAT) {
    mavlink_heartbeat_t heartbeat;
    mavlink_msg_heartbeat_decode(&message, &heartbeat);
    heard_now.vehicle_type = heartbeat.type;
  } else if (message.msgid == MAVLINK_MSG_ID_TIMESYNC && character.answers_timesync) {
    mavlink_timesync_t request;
    mavlink_msg_timesync_decode(&message, &request);
    answers_ = std::move(answers_) + frames_.timesync(clock(now).time_since_epoch().count(), request.ts1);
  } else if (message.msgid == MAVLINK_MSG_ID_COMMAND_LONG) {
    mavlink_command_long_t command;
    mavlink_msg_command_long_decode(&message, &command);
    EXPECT_EQ(command.command, MAV_CMD_SET_MESSAGE_INTERVAL);
    EXPECT_EQ((MavAddress{command.target_system, command.target_component}), (MavAddress{1, 1}));
    heard_now.wanted_message_id = static_cast<std::uint32_t>(command.param1);
    heard_now.wanted_rate_hz = 1e6 / command.param2;
    obey_interval(heard_now);
  } else if (message.msgid == MAVLINK_MSG_ID_REQUEST_DATA_STREAM) {
    mavlink_request_data_stream_t request;
    mavlink_msg_request_data_stream_decode(&message, &request);
    heard_now.data_stream = request.req_stream_id;
    heard_now.wanted_rate_hz = request.req_message_rate;
    obey_data_stream(heard_now);
  }
  heard.push_back(heard_now);
}

void FakeAutopilot::obey_interval(const Heard& request) {
  if (character.obeys_intervals) {
    streams_[request.wanted_message_id] = {period_of(request.wanted_rate_hz), request.at};
  }
  if (character.answer) answers_ = std::move(answers_) + frames_.command_ack(511, *character.answer);
}

void FakeAutopilot::obey_data_stream(const Heard& request) {
  if (!character.obeys_data_streams) return;
  const Stream stream{period_of(request.wanted_rate_hz), request.at};
  if (request.data_stream == MAV_DATA_STREAM_EXTRA1) streams_[MAVLINK_MSG_ID_ATTITUDE] = stream;
  if (request.data_stream == MAV_DATA_STREAM_POSITION) streams_[MAVLINK_MSG_ID_GLOBAL_POSITION_INT] = stream;
}

Bytes FakeAutopilot::say(std::uint32_t message_id, HostTime now) {
  switch (message_id) {
    case MAVLINK_MSG_ID_ATTITUDE:
      return frames_.attitude(clock(now), 0.1);
    case MAVLINK_MSG_ID_GLOBAL_POSITION_INT:
      return frames_.position(clock(now), -22.9, -43.1);
    case MAVLINK_MSG_ID_GPS_RAW_INT:
      return frames_.gnss(3);
    case MAVLINK_MSG_ID_SYSTEM_TIME:
      return frames_.system_time(clock(now));
    case MAVLINK_MSG_ID_EKF_STATUS_REPORT:
      return frames_.ekf_status(831);
    default:
      return {};
  }
}

Bytes FakeAutopilot::transmit(HostTime now) {
  if (character.is_mute) return {};
  Bytes said = std::move(answers_);
  answers_.clear();
  if (now >= next_heartbeat_) {
    next_heartbeat_ = now + std::chrono::seconds{1};
    said = std::move(said) + frames_.heartbeat(character.autopilot);
  }
  for (auto& [message_id, stream] : streams_) {
    if (now < stream.next) continue;
    stream.next += stream.period;
    said = std::move(said) + say(message_id, now);
  }
  return said;
}

std::vector<FakeAutopilot::Heard> FakeAutopilot::heard_of(std::uint32_t message_id) const {
  std::vector<Heard> found;
  std::copy_if(heard.begin(), heard.end(), std::back_inserter(found),
               [&](const Heard& one) { return one.message_id == message_id; });
  return found;
}

std::vector<FakeAutopilot::Heard> FakeAutopilot::requests_for(std::uint32_t message_id) const {
  std::vector<Heard> found;
  std::copy_if(heard.begin(), heard.end(), std::back_inserter(found),
               [&](const Heard& one) { return one.wanted_message_id == message_id; });
  return found;
}

void Session::run(Duration duration) {
  for (const HostTime end = now + duration; now < end; now += std::chrono::milliseconds{10}) {
    for (; to_autopilot_.size() >= static_cast<std::size_t>(delay); to_autopilot_.pop_front()) {
      for (const Bytes& frame : to_autopilot_.front()) autopilot.receive(frame.data(), frame.size(), now);
    }
    std::vector<Bytes>& sent = to_autopilot_.emplace_back();
    const Bytes said = autopilot.transmit(now);
    link.consume(now, said.data(), said.size(), sink);
    link.poll(now,
              [&](const std::uint8_t* frame, std::size_t size) { sent.emplace_back(frame, frame + size); });
  }
}

}  // namespace geoloc::io::testing
