// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/link_guard.hpp"

#include <algorithm>
#include <variant>

#include "geoloc/io/mavlink/vehicle_choice.hpp"
#include "mav_numbers.hpp"
#include "timing.hpp"

namespace geoloc::io {

LinkGuard::LinkGuard(const MavlinkConfig& config, const std::optional<LinkSigning>& signing)
    : component_id_(config.component_id), signing_(signing), sources_(from_seconds(config.link_timeout_s)) {}

void LinkGuard::receive(HostTime now, const LinkSource& source, const std::uint8_t* data, std::size_t size,
                        const Admit& admit) {
  FrameParser& parser = stream_of(source, now).parser;
  while (size > 0) {
    const std::size_t taken = parser.append(data, size);
    data += taken;
    size -= taken;
    while (const auto frame = parser.next()) {
      if (!admits(*frame, source, now)) continue;
      ++counts_.admitted;
      admit(frame->bytes, frame->size);
    }
  }
}

/// A new source takes the place of the one that has been silent for longest.
LinkGuard::Stream& LinkGuard::stream_of(const LinkSource& source, HostTime now) {
  Stream* const known = std::find_if(streams_.begin(), streams_.end(),
                                     [&](const Stream& stream) { return stream.source == source; });
  Stream& stream =
      known != streams_.end()
          ? *known
          : *std::min_element(streams_.begin(), streams_.end(),
                              [](const Stream& a, const Stream& b) { return a.last_heard < b.last_heard; });
  if (known == streams_.end()) {
    stream.source = source;
    stream.parser = FrameParser{};
  }
  stream.last_heard = now;
  return stream;
}

bool LinkGuard::admits(const Frame& frame, const LinkSource& source, HostTime now) {
  if (!is_signed_well(frame, now)) return false;
  const Message message = decode(frame);
  if (!sources_.admits(frame.sender, is_state(message), source, now)) {
    ++counts_.second_source;
    return false;
  }
  if (is_unasked(frame, message)) {
    ++counts_.unasked_timesyncs;
    return false;
  }
  if (signing_) signing_->note(frame);
  return true;
}

bool LinkGuard::is_signed_well(const Frame& frame, HostTime now) {
  if (!signing_) return true;
  switch (signing_->check(frame)) {
    case LinkSigning::Verdict::kValid:
      return true;
    case LinkSigning::Verdict::kUnsigned:
      ++counts_.unsigned_frames;
      break;
    case LinkSigning::Verdict::kWrong:
      ++counts_.wrong_signatures;
      break;
    case LinkSigning::Verdict::kRepeated:
      ++counts_.repeated_signatures;
      break;
  }
  last_refused_signature_ = now;
  return false;
}

/// An autopilot's answer that bears our mark, to a request that was not ours or that it has answered.
bool LinkGuard::is_unasked(const Frame& frame, const Message& message) {
  const auto* const answer = std::get_if<Timesync>(&message);
  const bool is_to_us = answer != nullptr && frame.sender.component == kAutopilotComponent &&
                        answer->vehicle_ns != 0 &&
                        answer->requester_ns % kNanosecondsPerStamp == component_id_;
  return is_to_us && !timesyncs_.take_answer(frame.sender.system, answer->requester_ns);
}

OutgoingFrame LinkGuard::outgoing(HostTime now, const std::uint8_t* frame, std::size_t size) {
  OutgoingFrame sent;
  sent.size = std::min(size, sent.bytes.size());
  std::copy_n(frame, sent.size, sent.bytes.begin());
  FrameParser parser;
  parser.append(frame, size);
  if (const auto ours = parser.next()) {
    const Message message = decode(*ours);
    if (const auto* const request = std::get_if<Timesync>(&message))
      timesyncs_.note_request(request->requester_ns);
  }
  return signing_ ? signing_->sign(sent, now) : sent;
}

std::optional<SigningStamps> LinkGuard::signing_stamps() const {
  if (!signing_) return std::nullopt;
  return signing_->stamps();
}

}  // namespace geoloc::io
