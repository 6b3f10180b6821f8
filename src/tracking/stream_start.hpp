// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "geoloc/geometry/time.hpp"

namespace geoloc {

/// What the stamps of a run of frames are off by together, besides the latency: a stream's first frames are
/// stamped by their arrival, until the sender's clock is known.
struct RunTimeError {
  double sigma_s = 0.0;  ///< 1-sigma; 0: none
  double frames = 1.0;   ///< that share it
};

/// Finds the runs: frames whose stamps are stated to be uncertain, and where nothing is stated, those of the
/// first seconds after the stream began or began anew.
class StreamStart {
 public:
  /// A frame stamped `now`. stated_sigma_s: of the stamp, 0 where nothing is stated; own_sigma_s: that of
  /// each frame by itself.
  RunTimeError observe(HostTime now, double stated_sigma_s, double own_sigma_s) {
    if (newest_) take_interval(seconds(now - *newest_));
    if (!newest_) begin_at(now);
    newest_ = now;
    const double frames = std::max(1.0, kRun_s / std::max(usual_interval_s_, 1e-3));
    if (stated_sigma_s > 0.0) {
      const double excess = stated_sigma_s * stated_sigma_s - own_sigma_s * own_sigma_s;
      return {excess > 0.0 ? std::sqrt(excess) : 0.0, frames};
    }
    const bool is_start = is_stream_ && seconds(now - started_at_) < kRun_s && now >= started_at_;
    return is_start ? RunTimeError{kSigmaOfArrival_s, frames} : RunTimeError{};
  }

 private:
  /// From connecting to the second report of the sender's clock, and the usual delay of a stream.
  static constexpr double kRun_s = 3.0, kSigmaOfArrival_s = 0.3;
  /// A pause is one of the stream, not of a slow detector, where it is longer than this and than so many
  /// usual intervals. Frames that always come seconds apart are no stream.
  static constexpr double kPause_s = 1.5, kIntervalsOfPause = 6.0;
  static constexpr double kMostOfStream_s = 1.0;

  void begin_at(HostTime start) {
    started_at_ = start;
    is_stream_ = true;
  }

  void take_interval(double interval_s) {
    if (usual_interval_s_ >= kMostOfStream_s) {
      is_stream_ = false;
    } else if (interval_s > std::max(kPause_s, kIntervalsOfPause * usual_interval_s_)) {
      begin_at(*newest_ + from_seconds(interval_s));
    }
    if (interval_s > 0.0)
      usual_interval_s_ += kForgetting * (std::min(interval_s, 2.0 * kMostOfStream_s) - usual_interval_s_);
  }

  static constexpr double kForgetting = 0.1;
  std::optional<HostTime> newest_;
  HostTime started_at_{};
  bool is_stream_ = false;
  double usual_interval_s_ = 0.1;
};

}  // namespace geoloc
