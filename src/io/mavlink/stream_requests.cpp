// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/stream_requests.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "mav_numbers.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

/// Share of the wanted rate that is enough: autopilots round intervals to their scheduler, and links lose
/// messages.
constexpr double kEnough = 0.6;
constexpr Duration kFirstLook = 1s;
constexpr Duration kAnswerTimeout = 1s;
constexpr Duration kTimeToTakeEffect = 3s;
constexpr Duration kPauseAfterDenial = 10s;
constexpr Duration kLongestPause = 30s;
/// Number of unanswered requests after which the old request is tried in turn with the new one.
constexpr int kPatience = 2;

Duration pause_after(int attempts) {
  constexpr int kDoublings = 5;
  return std::min<Duration>(1s * (1 << std::min(attempts - 1, kDoublings)), kLongestPause);
}

}  // namespace

void StreamRequests::want(const std::vector<WantedStream>& streams, HostTime now) {
  std::vector<Stream> wanted_now;
  for (const WantedStream& wanted : streams)
    wanted_now.push_back({wanted, {}, {}, 0, Answer::kNone, was_wanted_more(wanted)});
  streams_ = std::move(wanted_now);
  restart(now);
}

bool StreamRequests::was_wanted_more(const WantedStream& wanted) const {
  return std::any_of(streams_.begin(), streams_.end(), [&](const Stream& before) {
    return before.wanted.message_id == wanted.message_id && before.wanted.rate_hz > wanted.rate_hz;
  });
}

void StreamRequests::restart(HostTime now) {
  open_.reset();
  for (Stream& stream : streams_) {
    stream.meter.restart(now);
    stream.next_look = now + kFirstLook;
    stream.attempts = 0;
    stream.answer = Answer::kNone;
  }
}

void StreamRequests::on_message(std::uint32_t message_id, HostTime received_at) {
  for (Stream& stream : streams_) {
    if (stream.wanted.message_id == message_id) stream.meter.add(received_at);
  }
}

void StreamRequests::on_answer(std::uint8_t result, HostTime received_at) {
  if (!open_ || result == kInProgress) return;
  Stream& stream = streams_[*open_];
  open_.reset();
  stream.is_to_slow_down = false;
  if (result == kAccepted) {
    stream.answer = Answer::kGranted;
    stream.next_look = std::max(stream.next_look, received_at + kTimeToTakeEffect);
    return;
  }
  ++counts_.denials;
  if (result == kUnsupported && stream.wanted.data_stream != 0) {
    stream.answer = Answer::kCommandUnknown;
    stream.next_look = received_at;
    return;
  }
  stream.answer = Answer::kDenied;
  stream.next_look = std::max(stream.next_look, received_at + kPauseAfterDenial);
}

std::optional<StreamRequest> StreamRequests::next(HostTime now) {
  if (open_ && now < open_until_) return std::nullopt;
  open_.reset();
  for (Stream& stream : streams_) {
    if (now < stream.next_look) continue;
    if (stream.is_to_slow_down || stream.meter.rate_hz(now) < kEnough * stream.wanted.rate_hz)
      return ask(stream, now);
    stream.attempts = 0;
    stream.next_look = now + kFirstLook;
  }
  return std::nullopt;
}

StreamRequest::Method StreamRequests::method_for(const Stream& stream) {
  const bool is_unanswered = stream.answer == Answer::kNone && stream.wanted.data_stream != 0;
  const bool is_old_ways_turn = is_unanswered && stream.attempts > kPatience && stream.attempts % 2 == 1;
  return stream.answer == Answer::kCommandUnknown || is_old_ways_turn
             ? StreamRequest::Method::kDataStream
             : StreamRequest::Method::kMessageInterval;
}

StreamRequest StreamRequests::ask(Stream& stream, HostTime now) {
  ++counts_.requests;
  ++stream.attempts;
  stream.next_look = now + pause_after(stream.attempts);
  const StreamRequest request{stream.wanted, method_for(stream)};
  if (request.method == StreamRequest::Method::kMessageInterval) {
    open_ = static_cast<std::size_t>(&stream - streams_.data());
    open_until_ = now + kAnswerTimeout;
  }
  return request;
}

}  // namespace geoloc::io
