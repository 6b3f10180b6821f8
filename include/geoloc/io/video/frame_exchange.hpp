// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "geoloc/io/video/video_source.hpp"

namespace geoloc::io {

/// Where a decoding thread leaves frames and a consumer takes them: room for one frame, and the counters of
/// the source. Every call is safe from any thread.
class FrameExchange {
 public:
  /// Replaces a frame that nobody took; it counts as dropped. Ignored after end().
  void offer(VideoFrame frame);

  /// Waits until the frame before it was taken, so that none is dropped. False after end().
  bool offer_and_wait(VideoFrame frame);

  /// See VideoSource::next().
  std::optional<VideoFrame> take(Duration timeout);

  /// No frame will come any more; what was offered can still be taken. Frees whoever waits.
  void end();

  void set_state(VideoState state);
  void begin_attempt();
  void report_error(std::string message);
  void count_refused();
  void add_lost_packets(std::uint64_t count);

  VideoStatus status(HostTime now) const;

 private:
  void place(VideoFrame frame);
  bool is_ended() const { return status_.state == VideoState::kEnded; }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<VideoFrame> frame_;
  VideoStatus status_;
  std::deque<HostTime> recent_;  // when the frames of the last seconds came
};

}  // namespace geoloc::io
