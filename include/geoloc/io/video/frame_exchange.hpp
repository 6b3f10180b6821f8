// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/video/video_source.hpp"

namespace geoloc::io {

/// Passes frames from a decoding thread to a consumer: it holds one frame, and the counters of the source.
/// Thread-safe.
class FrameExchange {
 public:
  /// Replaces a frame that nobody took; it counts as dropped. Ignored after end().
  void offer(VideoFrame frame);

  /// Waits until the previous frame was taken, so that none is dropped. False after end().
  bool offer_and_wait(VideoFrame frame);

  /// See VideoSource::next().
  std::optional<VideoFrame> take(Duration timeout);

  /// See VideoSource::take_telemetry().
  std::vector<FrameTelemetry> take_telemetry();

  /// No more frames will come; an offered frame can still be taken. Wakes all waiting threads.
  void end();

  void set_state(VideoState state);
  void begin_attempt();
  void report_error(std::string message);
  void count_refused();
  /// A packet came, after so many others that did not.
  void count_packet(std::uint64_t lost_before);

  VideoStatus status(HostTime now) const;

 private:
  void place(VideoFrame frame);
  bool is_ended() const { return status_.state == VideoState::kEnded; }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<VideoFrame> frame_;
  std::deque<FrameTelemetry> telemetry_;  // that nobody took
  VideoStatus status_;
  std::deque<HostTime> recent_;  // when the frames of the last seconds came
};

}  // namespace geoloc::io
