// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/klv/transport_stream.hpp"

#include <gst/app/gstappsink.h>
#include <gst/app/gstappsrc.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "io/gst/gst_elements.hpp"
#include "io/gst/gst_handles.hpp"

namespace geoloc::io {
namespace {

constexpr guint64 kMostWaiting_bytes = 8U << 20U;
constexpr GstClockTime kPause = 10 * GST_MSECOND;
constexpr GstClockTime kPatience = 4 * GST_SECOND;  // a sink that makes no progress for five is abandoned
constexpr int kPacketsAtOnce = 7;

GstClockTime clock_time(Duration time) {
  return static_cast<GstClockTime>(std::max<Duration::rep>(0, time.count()));
}

GstBufferPtr buffer_of(const std::string& bytes, Duration shown_at) {
  GstBufferPtr buffer{gst_buffer_new_memdup(bytes.data(), bytes.size())};
  GST_BUFFER_PTS(buffer.get()) = clock_time(shown_at);
  return buffer;
}

const char* parser_of(const std::string& video_format) {
  const auto is = [&](const char* name) { return video_format.rfind(name, 0) == 0; };
  if (is("video/x-h264")) return "h264parse";
  if (is("video/x-h265")) return "h265parse";
  throw std::runtime_error("the video is neither H.264 nor H.265: " + video_format);
}

GstAppSrc* add_source(GstElement* pipeline, const std::string& format) {
  GstAppSrc* const source = GST_APP_SRC(add_element(pipeline, "appsrc"));
  const GstCapsPtr caps{gst_caps_from_string(format.c_str())};
  g_object_set(source, "caps", caps.get(), "format", GST_FORMAT_TIME, "max-bytes", guint64{0}, nullptr);
  return source;
}

}  // namespace

class TransportStream::Impl {
 public:
  Impl(std::string name, std::string video_format, Write write)
      : name_(std::move(name)), format_(std::move(video_format)), write_(std::move(write)) {
    require();
    pipeline_.reset(gst_pipeline_new(nullptr));
    build();
    gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING);
  }

  void add(const EncodedPicture& picture) {
    while (gst_app_src_get_current_level_bytes(video_) > kMostWaiting_bytes) check(kPause);
    check(0);
    if (picture.format != format_) change_format(picture.format);
    GstBufferPtr buffer = buffer_of(picture.bytes, picture.shown_at);
    if (picture.decoded_at) GST_BUFFER_DTS(buffer.get()) = clock_time(*picture.decoded_at);
    gst_app_src_push_buffer(video_, buffer.release());
  }

  void add_metadata(const std::string& set, Duration shown_at) {
    check(0);
    GstBufferPtr buffer = buffer_of(set, shown_at);
    GST_BUFFER_DTS(buffer.get()) = GST_BUFFER_PTS(buffer.get());
    gst_app_src_push_buffer(metadata_, buffer.release());
  }

  void none_until(Duration shown_at) {
    gst_element_send_event(GST_ELEMENT(metadata_), gst_event_new_gap(clock_time(shown_at), 0));
  }

  void finish() {
    if (video_ != nullptr) gst_app_src_end_of_stream(video_);
    gst_app_src_end_of_stream(metadata_);
    if (!check(kPatience)) fail("the stream does not end");
    pipeline_.reset();
  }

 private:
  void build() {
    GstElement* const muxer = add_element(pipeline_.get(), "mpegtsmux");
    g_object_set(muxer, "alignment", kPacketsAtOnce, nullptr);
    GstElement* const sink = add_element(pipeline_.get(), "appsink");
    g_object_set(sink, "sync", FALSE, nullptr);
    GstAppSinkCallbacks callbacks{};
    callbacks.new_sample = on_packets;
    gst_app_sink_set_callbacks(GST_APP_SINK(sink), &callbacks, this, nullptr);
    bool fits = gst_element_link(muxer, sink) != FALSE;
    if (!format_.empty()) {
      video_ = add_source(pipeline_.get(), format_);
      GstElement* const parser = add_element(pipeline_.get(), parser_of(format_));
      g_object_set(parser, "config-interval", -1, nullptr);  // whoever joins needs the parameter sets
      fits = fits && gst_element_link_many(GST_ELEMENT(video_), parser, muxer, nullptr) != FALSE;
    }
    metadata_ = add_source(pipeline_.get(), "meta/x-klv, parsed=(boolean)true");
    fits = fits && gst_element_link(GST_ELEMENT(metadata_), muxer) != FALSE;
    if (!fits) fail("GStreamer's elements do not fit together");
  }

  [[noreturn]] void fail(const std::string& reason) const { throw std::runtime_error(name_ + ": " + reason); }

  void change_format(const std::string& format) {
    const GstCapsPtr caps{gst_caps_from_string(format.c_str())};
    gst_app_src_set_caps(video_, caps.get());
    format_ = format;
  }

  /// Whether the stream has ended as it should, within the wait. Throws where it has otherwise.
  bool check(GstClockTime wait) {
    const GstObjectPtr<GstBus> bus{gst_element_get_bus(pipeline_.get())};
    const GstMessagePtr message{gst_bus_timed_pop_filtered(
        bus.get(), wait, static_cast<GstMessageType>(GST_MESSAGE_ERROR | GST_MESSAGE_EOS))};
    {
      const std::lock_guard lock(mutex_);
      if (fault_) std::rethrow_exception(fault_);
    }
    if (!message) return false;
    if (GST_MESSAGE_TYPE(message.get()) == GST_MESSAGE_EOS) return true;
    fail(error_text(message.get()));
  }

  static GstFlowReturn on_packets(GstAppSink* sink, gpointer self) {
    const GstSamplePtr sample{gst_app_sink_pull_sample(sink)};
    GstMapInfo map;
    GstBuffer* const buffer = sample ? gst_sample_get_buffer(sample.get()) : nullptr;
    if (buffer == nullptr || gst_buffer_map(buffer, &map, GST_MAP_READ) == FALSE) return GST_FLOW_OK;
    const bool goes_on = static_cast<Impl*>(self)->take({reinterpret_cast<const char*>(map.data), map.size});
    gst_buffer_unmap(buffer, &map);
    return goes_on ? GST_FLOW_OK : GST_FLOW_ERROR;
  }

  /// An exception must not pass through C.
  bool take(std::string_view packets) {
    try {
      write_(packets);
      return true;
    } catch (const std::exception&) {
      const std::lock_guard lock(mutex_);
      fault_ = std::current_exception();
      return false;
    }
  }

  const std::string name_;
  std::string format_;  // of the last picture; empty: there is no video
  Write write_;
  std::mutex mutex_;
  std::exception_ptr fault_;       // of write_; guarded by the mutex
  GstAppSrc* video_ = nullptr;     // owned by the pipeline
  GstAppSrc* metadata_ = nullptr;  // owned by the pipeline
  GstPipelinePtr pipeline_;        // last: its threads end before what they use
};

void TransportStream::require() {
  init_gstreamer();
  for (const char* name : {"appsrc", "appsink"}) require_element(name, "gstreamer1.0-plugins-base");
  for (const char* name : {"mpegtsmux", "h264parse"}) require_element(name, "gstreamer1.0-plugins-bad");
}

TransportStream::TransportStream(std::string name, const std::string& video_format, Write write)
    : impl_(std::make_unique<Impl>(std::move(name), video_format, std::move(write))) {}

TransportStream::~TransportStream() = default;

void TransportStream::add(const EncodedPicture& picture) {
  impl_->add(picture);
}

void TransportStream::add_metadata(const std::string& set, Duration shown_at) {
  impl_->add_metadata(set, shown_at);
}

void TransportStream::none_until(Duration shown_at) {
  impl_->none_until(shown_at);
}

void TransportStream::finish() {
  impl_->finish();
}

}  // namespace geoloc::io
