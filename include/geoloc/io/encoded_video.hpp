// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

/// A picture of a video as it came, before it was decoded.
struct EncodedPicture {
  std::string format;                  ///< GStreamer's caps, of H.264 or H.265
  std::string bytes;                   ///< one access unit
  Duration shown_at{};                 ///< since the video began
  std::optional<Duration> decoded_at;  ///< where the video tells; before shown_at by as much as it reorders
};

/// Takes the video of a source that is passed on as it is. Any thread may call it.
class EncodedVideoTaker {
 public:
  virtual ~EncodedVideoTaker() = default;

  /// In the order of the stream, which is that of decoding.
  virtual void add(EncodedPicture picture) = 0;

  /// The picture shown at that time was decoded to the frame that was captured then.
  virtual void note_frame(HostTime captured_at, Duration shown_at) = 0;

 protected:
  EncodedVideoTaker() = default;
  EncodedVideoTaker(const EncodedVideoTaker&) = default;
  EncodedVideoTaker& operator=(const EncodedVideoTaker&) = default;
};

}  // namespace geoloc::io
