// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/frame_exchange.hpp"

#include <algorithm>
#include <utility>

namespace geoloc::io {
namespace {

constexpr Duration kRateWindow = std::chrono::seconds{2};
constexpr std::size_t kMostRecent = 1000;                 // bounds the memory, whatever a stream sends
constexpr std::size_t kMostTelemetry = 300;               // ten seconds of a usual stream
constexpr Duration kLongestWait = std::chrono::hours{1};  // Duration::max() would overflow the clock

}  // namespace

void FrameExchange::place(VideoFrame frame) {
  const HostTime now = frame.received_at;
  while (!recent_.empty() && (now - recent_.front() > kRateWindow || recent_.size() >= kMostRecent))
    recent_.pop_front();
  recent_.push_back(now);
  ++status_.frames;
  if (frame.damaged) ++status_.damaged;
  if (frame.telemetry) {
    ++status_.with_telemetry;
    if (telemetry_.size() >= kMostTelemetry) telemetry_.pop_front();
    telemetry_.push_back(*frame.telemetry);
  }
  status_.time_quality = frame.time_quality;
  status_.state = VideoState::kPlaying;
  frame_ = std::move(frame);
  changed_.notify_all();
}

void FrameExchange::offer(VideoFrame frame) {
  const std::lock_guard lock{mutex_};
  if (is_ended()) return;
  if (frame_) ++status_.dropped;
  place(std::move(frame));
}

bool FrameExchange::offer_and_wait(VideoFrame frame) {
  std::unique_lock lock{mutex_};
  changed_.wait(lock, [this] { return is_ended() || !frame_; });
  if (is_ended()) return false;
  place(std::move(frame));
  return true;
}

std::optional<VideoFrame> FrameExchange::take(Duration timeout) {
  std::unique_lock lock{mutex_};
  changed_.wait_for(lock, std::min(timeout, kLongestWait), [this] { return is_ended() || frame_; });
  auto taken = std::exchange(frame_, std::nullopt);
  changed_.notify_all();
  return taken;
}

std::vector<FrameTelemetry> FrameExchange::take_telemetry() {
  const std::lock_guard lock{mutex_};
  std::vector<FrameTelemetry> taken(telemetry_.begin(), telemetry_.end());
  telemetry_.clear();
  return taken;
}

void FrameExchange::end() {
  set_state(VideoState::kEnded);
}

void FrameExchange::set_state(VideoState state) {
  const std::lock_guard lock{mutex_};
  if (is_ended()) return;
  status_.state = state;
  changed_.notify_all();
}

void FrameExchange::begin_attempt() {
  const std::lock_guard lock{mutex_};
  ++status_.attempts;
}

void FrameExchange::report_error(std::string message) {
  const std::lock_guard lock{mutex_};
  status_.last_error = std::move(message);
}

void FrameExchange::count_refused() {
  const std::lock_guard lock{mutex_};
  ++status_.refused;
}

void FrameExchange::count_packet(std::uint64_t lost_before) {
  const std::lock_guard lock{mutex_};
  ++status_.packets;
  status_.lost_packets += lost_before;
}

VideoStatus FrameExchange::status(HostTime now) const {
  const std::lock_guard lock{mutex_};
  VideoStatus status = status_;
  const auto count =
      std::count_if(recent_.begin(), recent_.end(), [now](HostTime at) { return now - at <= kRateWindow; });
  status.frames_per_second = static_cast<double>(count) / seconds(kRateWindow);
  return status;
}

}  // namespace geoloc::io
