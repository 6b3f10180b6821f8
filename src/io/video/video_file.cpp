// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/video_file.hpp"

#include <gst/app/gstappsrc.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "geoloc/io/partial_file.hpp"
#include "gst_pipeline.hpp"
#include "io/gst/gst_elements.hpp"
#include "sei_buffer.hpp"

namespace geoloc::io {
namespace {

constexpr guint64 kLongestQueue = 4;
constexpr GstClockTime kPatience = 60 * GST_SECOND;

/// GStreamer's rows of BGR begin at multiples of four bytes.
GstBufferPtr to_buffer(const cv::Mat& bgr) {
  const int row_bytes = 3 * bgr.cols, stride = (row_bytes + 3) / 4 * 4;
  cv::Mat padded = cv::Mat::zeros(bgr.rows, stride, CV_8U);
  bgr.reshape(1).copyTo(padded.colRange(0, row_bytes));
  return GstBufferPtr{gst_buffer_new_memdup(padded.data, padded.total())};
}

}  // namespace

class VideoFile::Impl {
 public:
  Impl(std::filesystem::path file, cv::Size size, std::optional<HostTime> created_at)
      : file_(std::move(file)), partial_(file_), size_(size), created_at_(created_at) {
    init_gstreamer();
    pipeline_.reset(gst_pipeline_new(nullptr));
    build();
    gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING);
  }

  bool takes_telemetry() const { return is_h264_; }

  void add(const cv::Mat& bgr, Duration time, const std::optional<VideoTelemetry>& telemetry) {
    while (gst_app_src_get_current_level_buffers(source_) >= kLongestQueue)
      wait_for_message(GST_MESSAGE_ERROR, 10 * GST_MSECOND);
    wait_for_message(GST_MESSAGE_ERROR, 0);
    cv::Mat picture = bgr;
    if (bgr.size() != size_) cv::resize(bgr, picture, size_);
    GstBufferPtr buffer = to_buffer(picture);
    GST_BUFFER_PTS(buffer.get()) = static_cast<GstClockTime>(std::max<Duration::rep>(0, time.count()));
    if (telemetry && is_h264_) attach_telemetry(buffer.get(), to_json(*telemetry));
    gst_app_src_push_buffer(source_, buffer.release());
  }

  void finish() {
    gst_app_src_end_of_stream(source_);
    if (!wait_for_message(static_cast<GstMessageType>(GST_MESSAGE_EOS | GST_MESSAGE_ERROR), kPatience))
      fail("the encoder does not end");
    pipeline_.reset();
    partial_.commit();
  }

 private:
  void build() {
    source_ = GST_APP_SRC(add_element(pipeline_.get(), "appsrc"));
    const GstCapsPtr caps{gst_caps_new_simple("video/x-raw", "format", G_TYPE_STRING, "BGR", "width",
                                              G_TYPE_INT, size_.width, "height", G_TYPE_INT, size_.height,
                                              "framerate", GST_TYPE_FRACTION, 0, 1, nullptr)};
    g_object_set(source_, "caps", caps.get(), "format", GST_FORMAT_TIME, "max-bytes", guint64{0}, nullptr);
    GstElement* converter = add_element(pipeline_.get(), "videoconvert");
    GstElement* encoder = add_encoder();
    GstElement* muxer = add_element(pipeline_.get(), "matroskamux");
    if (created_at_) set_creation_time(muxer);
    GstElement* sink = add_element(pipeline_.get(), "filesink");
    g_object_set(sink, "location", partial_.name().c_str(), nullptr);
    bool fits = gst_element_link_many(GST_ELEMENT(source_), converter, encoder, nullptr) != FALSE &&
                gst_element_link(muxer, sink) != FALSE;
    fits =
        fits && (is_h264_ ? link_with_telemetry(encoder, muxer) : gst_element_link(encoder, muxer) != FALSE);
    if (!fits) fail("GStreamer's elements do not fit together");
  }

  /// Telemetry is written into the byte stream, from which the parser makes what the container has.
  bool link_with_telemetry(GstElement* encoder, GstElement* muxer) {
    const GstCapsPtr byte_stream{gst_caps_from_string("video/x-h264,stream-format=byte-stream,alignment=au")};
    const GstObjectPtr<GstPad> encoded{gst_element_get_static_pad(encoder, "src")};
    write_telemetry_at(encoded.get());
    GstElement* parser = add_element(pipeline_.get(), "h264parse");
    return gst_element_link_filtered(encoder, parser, byte_stream.get()) != FALSE &&
           gst_element_link(parser, muxer) != FALSE;
  }

  void set_creation_time(GstElement* muxer) const {
    const auto since_1970 = std::chrono::floor<std::chrono::seconds>(created_at_->time_since_epoch());
    GDateTime* const time = g_date_time_new_from_unix_utc(since_1970.count());
    g_object_set(muxer, "creation-time", time, nullptr);
    g_date_time_unref(time);
  }

  GstElement* add_encoder() {
    const bool is_even = size_.width % 2 == 0 && size_.height % 2 == 0;
    is_h264_ = is_even && has_element("x264enc") && has_element("h264parse");
    if (!is_h264_) return add_element(pipeline_.get(), "jpegenc");
    GstElement* encoder = add_element(pipeline_.get(), "x264enc");
    gst_util_set_object_arg(G_OBJECT(encoder), "speed-preset", "veryfast");
    gst_util_set_object_arg(G_OBJECT(encoder), "pass", "quant");
    g_object_set(encoder, "quantizer", 20U, nullptr);
    return encoder;
  }

  /// Whether the message came; throws if it is an error.
  bool wait_for_message(GstMessageType types, GstClockTime timeout) {
    const GstObjectPtr<GstBus> bus{gst_element_get_bus(pipeline_.get())};
    const GstMessagePtr message{gst_bus_timed_pop_filtered(bus.get(), timeout, types)};
    if (message && GST_MESSAGE_TYPE(message.get()) == GST_MESSAGE_ERROR) fail(error_text(message.get()));
    return message != nullptr;
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error(file_.string() + ": cannot be written: " + reason);
  }

  std::filesystem::path file_;
  PartialFile partial_;
  cv::Size size_;
  std::optional<HostTime> created_at_;
  bool is_h264_ = false;
  GstPipelinePtr pipeline_;      // keeps the file open: destroyed first
  GstAppSrc* source_ = nullptr;  // owned by the pipeline
};

VideoFile::VideoFile(std::filesystem::path file, cv::Size size, std::optional<HostTime> created_at)
    : impl_(std::make_unique<Impl>(std::move(file), size, created_at)) {}

VideoFile::~VideoFile() = default;

void VideoFile::add(const cv::Mat& bgr, Duration time, const std::optional<VideoTelemetry>& telemetry) {
  impl_->add(bgr, time, telemetry);
}

bool VideoFile::takes_telemetry() const {
  return impl_->takes_telemetry();
}

void VideoFile::finish() {
  impl_->finish();
}

}  // namespace geoloc::io
