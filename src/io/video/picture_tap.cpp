// SPDX-License-Identifier: Apache-2.0
#include "picture_tap.hpp"

#include <exception>
#include <string>
#include <utility>

#include "io/gst/gst_handles.hpp"

namespace geoloc::io {
namespace {

/// Longer than any video; keeps a damaged time stamp from overflowing the clock.
constexpr GstClockTime kLongestVideo = 365ULL * 24 * 3600 * GST_SECOND;

std::optional<std::string> format_at(GstPad* pad) {
  const GstCapsPtr caps{gst_pad_get_current_caps(pad)};
  gchar* const text = caps ? gst_caps_to_string(caps.get()) : nullptr;
  if (text == nullptr) return std::nullopt;
  std::string format = text;
  g_free(text);
  return format;
}

}  // namespace

std::optional<Duration> running_time(const GstSegment* segment, GstClockTime time) {
  const guint64 running = gst_segment_to_running_time(segment, GST_FORMAT_TIME, time);
  if (running == GST_CLOCK_TIME_NONE || running > kLongestVideo) return std::nullopt;
  return Duration{static_cast<Duration::rep>(running)};
}

void PictureTap::open_at(GstPad* parsed) {
  if (!taker_ || std::exchange(is_open_, true)) return;
  gst_pad_add_probe(parsed, GST_PAD_PROBE_TYPE_BUFFER, on_picture, this, nullptr);
}

void PictureTap::note(const VideoFrame& frame, std::optional<Duration> running) const {
  if (!taker_ || !running) return;
  taker_->note_frame(frame.captured_at, begins_at_ + *running);
  if (frame.telemetry) taker_->note_frame(frame.telemetry->made_at, begins_at_ + *running);
}

GstPadProbeReturn PictureTap::on_picture(GstPad* pad, GstPadProbeInfo* info, gpointer self) {
  try {
    static_cast<const PictureTap*>(self)->take(pad, GST_PAD_PROBE_INFO_BUFFER(info));
  } catch (const std::exception&) {  // out of memory for the copy; an exception must not pass through C
  }
  return GST_PAD_PROBE_OK;
}

void PictureTap::take(GstPad* pad, GstBuffer* picture) const {
  const std::unique_ptr<GstEvent, Releaser<gst_event_unref>> begin{
      gst_pad_get_sticky_event(pad, GST_EVENT_SEGMENT, 0)};
  if (!begin) return;
  const GstSegment* segment = nullptr;
  gst_event_parse_segment(begin.get(), &segment);
  const auto shown_at = running_time(segment, GST_BUFFER_PTS(picture));
  auto format = format_at(pad);
  GstMapInfo map;
  if (!shown_at || !format || gst_buffer_map(picture, &map, GST_MAP_READ) == FALSE) return;
  EncodedPicture copy{std::move(*format), {map.data, map.data + map.size}, begins_at_ + *shown_at, {}};
  gst_buffer_unmap(picture, &map);
  if (const auto decoded_at = running_time(segment, GST_BUFFER_DTS(picture)))
    copy.decoded_at = begins_at_ + *decoded_at;
  taker_->add(std::move(copy));
}

}  // namespace geoloc::io
