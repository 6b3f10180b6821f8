// SPDX-License-Identifier: Apache-2.0
#include "gst_pipeline.hpp"

#include <gst/video/video.h>

#include <chrono>

#include "io/gst/gst_elements.hpp"

namespace geoloc::io {

GstElement* add_bgr_sink(GstElement* pipeline, GstAppSinkCallbacks callbacks, void* user) {
  GstElement* sink = add_element(pipeline, "appsink");
  const GstCapsPtr caps{gst_caps_from_string("video/x-raw,format=BGR")};
  g_object_set(sink, "caps", caps.get(), "max-buffers", 1U, "qos", FALSE, nullptr);
  gst_app_sink_set_callbacks(GST_APP_SINK(sink), &callbacks, user, nullptr);
  return sink;
}

std::optional<HostTime> creation_time_of(const GstTagList* tags) {
  GstDateTime* told = nullptr;
  if (gst_tag_list_get_date_time(tags, GST_TAG_DATE_TIME, &told) == FALSE) return std::nullopt;
  std::optional<HostTime> created_at;
  GDateTime* const time =
      gst_date_time_has_second(told) != FALSE ? gst_date_time_to_g_date_time(told) : nullptr;
  if (time != nullptr) {
    created_at = HostTime{std::chrono::seconds{g_date_time_to_unix(time)} +
                          std::chrono::microseconds{g_date_time_get_microsecond(time)}};
    g_date_time_unref(time);
  }
  gst_date_time_unref(told);
  return created_at;
}

std::optional<cv::Mat> copy_bgr(GstSample* sample, double max_megapixels) {
  GstCaps* caps = gst_sample_get_caps(sample);
  GstBuffer* buffer = gst_sample_get_buffer(sample);
  GstVideoInfo info;
  if (caps == nullptr || buffer == nullptr || gst_video_info_from_caps(&info, caps) == FALSE)
    return std::nullopt;
  const int width_px = GST_VIDEO_INFO_WIDTH(&info);
  const int height_px = GST_VIDEO_INFO_HEIGHT(&info);
  const bool is_usable = GST_VIDEO_INFO_FORMAT(&info) == GST_VIDEO_FORMAT_BGR && width_px > 0 &&
                         height_px > 0 && 1e-6 * width_px * height_px <= max_megapixels;
  GstVideoFrame frame;
  if (!is_usable || gst_video_frame_map(&frame, &info, buffer, GST_MAP_READ) == FALSE) return std::nullopt;
  const auto stride = static_cast<std::size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0));
  cv::Mat copy;
  cv::Mat{height_px, width_px, CV_8UC3, GST_VIDEO_FRAME_PLANE_DATA(&frame, 0), stride}.copyTo(copy);
  gst_video_frame_unmap(&frame);
  return copy;
}

}  // namespace geoloc::io
