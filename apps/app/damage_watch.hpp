// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <string>

#include "geoloc/io/video/video_config.hpp"
#include "geoloc/io/video/video_source.hpp"

namespace geoloc::apps {

/// Notices that packets of a stream are lost and that frames are damaged by it: they are left out, so a
/// stream that plays may give next to none.
class DamageWatch {
 public:
  explicit DamageWatch(io::RtspTransport transport) : transport_(transport) {}

  /// Once a second or so. What is to be said; empty while all is well. The text stays as it is for a while,
  /// so that figures which change do not make it new.
  const std::string& observe(HostTime now, const io::VideoStatus& video);

  /// So long after the last lost packet, all is well again.
  static constexpr Duration kWindow = std::chrono::seconds{10};
  /// Fewer damaged frames are not worth a word.
  static constexpr double kTolerableShare = 0.1;

 private:
  struct Sample {
    HostTime at;
    std::uint64_t frames, damaged, packets, lost;
  };

  std::string text(const Sample& since, const Sample& now) const;

  io::RtspTransport transport_;
  std::deque<Sample> samples_;  // of the window, the oldest first
  std::string text_;
  HostTime written_at_{};
};

}  // namespace geoloc::apps
