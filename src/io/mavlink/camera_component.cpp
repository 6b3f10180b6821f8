// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/camera_component.hpp"

#include <algorithm>
#include <cmath>

#include "mav_numbers.hpp"
#include "timing.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kInformation = 259, kFieldOfView = 271, kTracking = 276;

constexpr Duration kLeastPeriod = 100ms;  // whatever is requested, because the link is the vehicle's
constexpr Duration kLongestPeriod = 1h;
constexpr Duration kViewLasts = 3s;
constexpr std::size_t kMostReplies = 16;    // waiting, or in a row; the others of a flood have none
constexpr double kRepliesPerSecond = 10.0;  // in the long run
constexpr double kReach = 0.1;              // of the image: a point selects an object that is nearer

/// A message's number in a command's parameter; nullopt if it is not valid.
std::optional<std::uint32_t> message_number(float parameter) {
  constexpr float kLargest = 16'777'215.0F;
  if (!(parameter >= 0.0F && parameter <= kLargest)) return std::nullopt;
  return static_cast<std::uint32_t>(parameter);
}

}  // namespace

CameraComponent::CameraComponent(std::uint8_t component_id, const CameraIntrinsics& image)
    : component_id_(component_id), image_(image), replies_allowed_(kMostReplies) {}

void CameraComponent::consume(const std::uint8_t* frame, std::size_t size) {
  while (size > 0) {
    const std::size_t taken = parser_.append(frame, size);
    frame += taken;
    size -= taken;
    while (const auto next = parser_.next()) {
      if (const auto command = decode_command(*next)) obey(*command, next->sender);
    }
  }
}

void CameraComponent::obey(const Command& command, MavAddress sender) {
  const bool is_for_us = command.target.system == system_ && command.target.component == component_id_;
  const bool is_for_all =
      (command.target.system == system_ || command.target.system == 0) && command.target.component == 0 &&
      (command.command == kRequestMessage || command.command == kRequestCameraInformation);
  if (system_ == 0 || (!is_for_us && !is_for_all)) return;
  Reply reply = answer(command);
  reply.to = sender;
  reply.command = command.command;
  if (is_for_all && reply.result != kAccepted) return;  // another component may support it
  queue(reply);
}

/// One answer to a command that is repeated before it was answered, so that it leaves room for others'.
void CameraComponent::queue(const Reply& reply) {
  const auto same = std::find_if(replies_.begin(), replies_.end(), [&](const Reply& waiting) {
    return waiting.to == reply.to && waiting.command == reply.command &&
           waiting.message_id == reply.message_id;
  });
  if (same != replies_.end()) {
    *same = reply;
  } else if (replies_.size() < kMostReplies) {
    replies_.push_back(reply);
  }
}

CameraComponent::Reply CameraComponent::answer(const Command& command) {
  Reply reply;
  reply.result = kUnsupported;
  switch (command.command) {
    case kRequestMessage:
      if (const auto id = message_number(command.parameters[0])) return answer_request(*id);
      break;
    case kRequestCameraInformation:
      return answer_request(kInformation);
    case kSetMessageInterval:
      reply.result = set_interval(command);
      break;
    case kTrackPoint:
      reply.result = track_point(command);
      break;
    case kStopTracking:
      selected_.reset();
      reply.result = kAccepted;
      break;
    default:
      break;
  }
  return reply;
}

CameraComponent::Reply CameraComponent::answer_request(std::uint32_t message_id) const {
  Reply reply;
  const bool is_known = message_id == kInformation || message_id == kFieldOfView || message_id == kTracking;
  reply.result = !is_known ? kUnsupported : message_id == kInformation || view_ ? kAccepted : kRejectedForNow;
  if (reply.result == kAccepted) reply.message_id = message_id;
  return reply;
}

std::uint8_t CameraComponent::set_interval(const Command& command) {
  const auto id = message_number(command.parameters[0]);
  if (!id || (*id != kTracking && *id != kFieldOfView)) return kUnsupported;
  Stream& stream = *id == kTracking ? tracking_ : field_of_view_;
  const float interval_us = command.parameters[1];
  if (!std::isfinite(interval_us)) return kDenied;
  if (interval_us < 0.0F) {
    stream.period.reset();
  } else if (interval_us == 0.0F) {
    stream.period = *id == kTracking ? std::optional<Duration>(1s) : std::nullopt;
  } else {
    const double longest_us = std::chrono::duration<double, std::micro>(kLongestPeriod).count();
    stream.period = std::max(kLeastPeriod, from_seconds(1e-6 * std::min<double>(interval_us, longest_us)));
  }
  return kAccepted;
}

std::uint8_t CameraComponent::track_point(const Command& command) {
  if (!view_) return kRejectedForNow;
  const Eigen::Vector2d point(command.parameters[0], command.parameters[1]);
  const CameraTarget* nearest = nullptr;
  double least = kReach;
  for (const CameraTarget& target : view_->targets) {
    if (!target.image_point) continue;
    const double distance = (*target.image_point - point).norm();
    if (!(distance < least)) continue;
    least = distance;
    nearest = &target;
  }
  if (nearest == nullptr) return kDenied;
  selected_ = nearest->id;
  return kAccepted;
}

void CameraComponent::update(const CameraView& view) {
  view_ = view;
}

const CameraTarget* CameraComponent::tracked() const {
  const auto& targets = view_->targets;
  const auto selected = std::find_if(targets.begin(), targets.end(), [this](const CameraTarget& target) {
    return selected_ && target.id == *selected_;
  });
  if (selected != targets.end()) return &*selected;
  const auto nearest = std::min_element(
      targets.begin(), targets.end(),
      [](const CameraTarget& a, const CameraTarget& b) { return a.distance_m < b.distance_m; });
  return nearest != targets.end() ? &*nearest : nullptr;
}

bool CameraComponent::has_fresh_view(HostTime now) const {
  return view_ && now - view_->captured_at <= kViewLasts;
}

void CameraComponent::send_message(std::uint32_t message_id, MavAddress self, const Send& send) {
  const auto write = [&](const OutgoingFrame& frame) { send(frame.bytes.data(), frame.size); };
  if (message_id == kInformation)
    write(writer_.information(self, view_ ? view_->time : VehicleTime{}, image_));
  if (message_id == kFieldOfView && view_) write(writer_.field_of_view(self, *view_, image_));
  if (message_id == kTracking && view_) write(writer_.tracking(self, tracked()));
}

void CameraComponent::send_replies(HostTime now, MavAddress self, const Send& send) {
  const double pause_s = replies_allowed_at_ ? std::max(0.0, seconds(now - *replies_allowed_at_)) : 0.0;
  replies_allowed_at_ = now;
  replies_allowed_ = std::min<double>(kMostReplies, replies_allowed_ + kRepliesPerSecond * pause_s);
  for (; !replies_.empty() && replies_allowed_ >= 1.0; replies_allowed_ -= 1.0) {
    const Reply reply = replies_.front();
    replies_.pop_front();
    const OutgoingFrame ack = writer_.command_ack(self, reply.to, reply.command, reply.result);
    send(ack.bytes.data(), ack.size);
    if (reply.message_id) send_message(*reply.message_id, self, send);
  }
}

void CameraComponent::poll(HostTime now, const std::optional<MavAddress>& vehicle, bool is_v2,
                           const Send& send) {
  if (!vehicle || !is_v2) return;
  system_ = vehicle->system;
  const MavAddress self{system_, component_id_};
  const auto write = [&](const OutgoingFrame& frame) { send(frame.bytes.data(), frame.size); };
  if (is_due(last_heartbeat_, kHeartbeatPeriod, now)) {
    last_heartbeat_ = now;
    write(writer_.heartbeat(self));
  }
  send_replies(now, self, send);
  for (Stream* stream : {&tracking_, &field_of_view_}) {
    if (!stream->period || !is_due(stream->sent_at, *stream->period, now) || !has_fresh_view(now)) continue;
    if (stream == &tracking_ && tracked() == nullptr)
      continue;  // sent only while there is something to track
    stream->sent_at = now;
    send_message(stream->message_id, self, send);
  }
}

}  // namespace geoloc::io
