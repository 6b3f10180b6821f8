// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gst/gst.h>

#include <memory>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/encoded_video.hpp"
#include "geoloc/io/video/video_frame.hpp"

namespace geoloc::io {

/// Hands a copy of a pipeline's encoded video to a taker, where there is one.
class PictureTap {
 public:
  /// `begins_at` is the pipeline's beginning in the video's time.
  explicit PictureTap(std::shared_ptr<EncodedVideoTaker> taker, Duration begins_at = {})
      : taker_(std::move(taker)), begins_at_(begins_at) {}

  /// Takes what leaves a parser: of several, the first. The tap must stay where it is for as long as the pad.
  void open_at(GstPad* parsed);

  /// Tells the taker which picture has become the frame: the one of that running time. A frame may be known
  /// by two times: that of its stamp and that of the telemetry in it.
  void note(const VideoFrame& frame, std::optional<Duration> running) const;

 private:
  static GstPadProbeReturn on_picture(GstPad* pad, GstPadProbeInfo* info, gpointer self);
  void take(GstPad* pad, GstBuffer* picture) const;

  std::shared_ptr<EncodedVideoTaker> taker_;
  Duration begins_at_;
  bool is_open_ = false;
};

/// A buffer's time from the pipeline's beginning; nullopt where it has none, or an absurd one.
std::optional<Duration> running_time(const GstSegment* segment, GstClockTime time);

}  // namespace geoloc::io
