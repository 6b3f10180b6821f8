// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/file_source.hpp"

#include <exception>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "geoloc/geometry/refuse.hpp"
#include "geoloc/io/video/camera_clock.hpp"
#include "geoloc/io/video/frame_exchange.hpp"
#include "gst_pipeline.hpp"
#include "io/gst/gst_elements.hpp"
#include "picture_tap.hpp"
#include "sei_buffer.hpp"

namespace geoloc::io {
namespace {

/// The sample's time from the beginning of the file.
std::optional<Duration> time_of(GstSample* sample) {
  return running_time(gst_sample_get_segment(sample), GST_BUFFER_PTS(gst_sample_get_buffer(sample)));
}

}  // namespace

class FileSource::Impl {
 public:
  Impl(const std::filesystem::path& file, const Playback& playback, const VideoConfig& config,
       const HostClock& clock, std::shared_ptr<EncodedVideoTaker> taker)
      : pace_(playback.pace),
        starts_at_(playback.starts_at),
        config_(config),
        clock_(clock),
        tap_(std::move(taker)) {
    refuse_if_any(config_.problems());
    if (!std::filesystem::is_regular_file(file))
      throw std::runtime_error(file.string() + ": there is no such file");
    init_gstreamer();
    pipeline_.reset(gst_pipeline_new(nullptr));
    build(file);
    open(file);
    gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING);
  }

  ~Impl() { exchange_.end(); }  // releases the streaming thread, for which the pipeline waits

  std::optional<VideoFrame> next(Duration timeout) { return exchange_.take(timeout); }
  std::vector<FrameTelemetry> take_telemetry() { return exchange_.take_telemetry(); }
  VideoStatus status() const { return exchange_.status(clock_.now()); }

  FileFacts facts() const {
    FileFacts facts;
    {
      const std::lock_guard lock(tags_mutex_);
      facts.created_at = created_at_;
    }
    gint64 length_ns = 0;
    if (gst_element_query_duration(pipeline_.get(), GST_FORMAT_TIME, &length_ns) != FALSE && length_ns > 0)
      facts.duration = Duration{length_ns};
    return facts;
  }

 private:
  bool is_ended() const { return status().state == VideoState::kEnded; }

  void build(const std::filesystem::path& file) {
    GstElement* source = add_element(pipeline_.get(), "filesrc");
    g_object_set(source, "location", file.c_str(), nullptr);
    GstElement* decoder = add_element(pipeline_.get(), "decodebin");
    converter_ = add_element(pipeline_.get(), "videoconvert");
    GstAppSinkCallbacks callbacks{};
    callbacks.new_sample = on_sample;
    callbacks.eos = [](GstAppSink*, gpointer self) { static_cast<Impl*>(self)->exchange_.end(); };
    GstElement* sink = add_bgr_sink(pipeline_.get(), callbacks, this);
    const gboolean is_real_time = pace_ == Pace::kRealTime ? TRUE : FALSE;
    g_object_set(sink, "sync", is_real_time, "drop", is_real_time, nullptr);
    gst_element_link(source, decoder);
    gst_element_link(converter_, sink);
    g_signal_connect(decoder, "element-added", G_CALLBACK(on_element), this);
    g_signal_connect(decoder, "pad-added", G_CALLBACK(on_pad), this);
    g_signal_connect(decoder, "no-more-pads", G_CALLBACK(on_all_pads), this);
    const GstObjectPtr<GstBus> bus{gst_element_get_bus(pipeline_.get())};
    gst_bus_set_sync_handler(bus.get(), on_message, this, nullptr);
  }

  /// Decodes the first frame, so that an unplayable file is reported before anything starts.
  void open(const std::filesystem::path& file) {
    constexpr Duration kPatience = std::chrono::seconds{10};
    const HostTime begun = clock_.now();
    auto result = gst_element_set_state(pipeline_.get(), GST_STATE_PAUSED);
    while (result == GST_STATE_CHANGE_ASYNC && !is_ended() && clock_.now() - begun < kPatience) {
      result = gst_element_get_state(pipeline_.get(), nullptr, nullptr, 20 * GST_MSECOND);
    }
    if (result == GST_STATE_CHANGE_SUCCESS && !is_ended()) return;
    if (!is_ended()) exchange_.take(std::chrono::milliseconds{500});  // the reason comes from another thread
    const std::string reason = status().last_error;
    throw std::runtime_error(file.string() + ": no video that can be decoded" +
                             (reason.empty() ? std::string{} : " (" + reason + ")"));
  }

  GstObjectPtr<GstPad> converter_pad() const {
    return GstObjectPtr<GstPad>{gst_element_get_static_pad(converter_, "sink")};
  }

  static void on_element(GstBin*, GstElement* element, gpointer self) {
    const GstElementFactory* const factory = gst_element_get_factory(element);
    const std::string_view name = factory != nullptr ? GST_OBJECT_NAME(factory) : "";
    if (name != "h264parse" && name != "h265parse") return;
    const GstObjectPtr<GstPad> parsed{gst_element_get_static_pad(element, "src")};
    if (name == "h265parse") read_telemetry_at(parsed.get());
    static_cast<Impl*>(self)->tap_.open_at(parsed.get());
  }

  /// Sound does not fit the converter, so it stays unlinked.
  static void on_pad(GstElement*, GstPad* pad, gpointer self) {
    const auto target = static_cast<Impl*>(self)->converter_pad();
    if (gst_pad_is_linked(target.get()) == FALSE) gst_pad_link(pad, target.get());
  }

  static void on_all_pads(GstElement* decoder, gpointer self) {
    if (gst_pad_is_linked(static_cast<Impl*>(self)->converter_pad().get()) != FALSE) return;
    GST_ELEMENT_ERROR(decoder, STREAM, WRONG_TYPE, ("there is no video in it"), (nullptr));
  }

  static GstBusSyncReply on_message(GstBus*, GstMessage* message, gpointer self) {
    if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR) {
      static_cast<Impl*>(self)->exchange_.report_error(error_text(message));
      static_cast<Impl*>(self)->exchange_.end();
    } else if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_TAG) {
      static_cast<Impl*>(self)->note_tags(message);
    }
    return GST_BUS_PASS;
  }

  void note_tags(GstMessage* message) {
    GstTagList* tags = nullptr;
    gst_message_parse_tag(message, &tags);
    const auto told = creation_time_of(tags);
    gst_tag_list_unref(tags);
    const std::lock_guard lock(tags_mutex_);
    if (told) created_at_ = told;
  }

  static GstFlowReturn on_sample(GstAppSink* sink, gpointer self) {
    const GstSamplePtr sample{gst_app_sink_pull_sample(sink)};
    if (!sample) return GST_FLOW_EOS;
    Impl& here = *static_cast<Impl*>(self);
    try {
      return here.deliver(sample.get()) ? GST_FLOW_OK : GST_FLOW_EOS;
    } catch (const std::exception&) {  // out of memory for the picture; an exception must not pass through C
      here.exchange_.count_refused();
      return GST_FLOW_OK;
    }
  }

  /// False if no more frames are wanted.
  bool deliver(GstSample* sample) {
    const HostTime now = clock_.now();
    auto bgr = copy_bgr(sample, config_.max_megapixels);
    const auto time = time_of(sample);
    if (!bgr || !time) {
      exchange_.count_refused();
      return true;
    }
    if (!starts_at_) starts_at_ = now - *time;
    const auto captured_at = std::chrono::floor<std::chrono::microseconds>(*starts_at_ + *time);
    VideoFrame frame{std::move(*bgr), captured_at, now, TimeQuality::kFile};
    frame.damaged = GST_BUFFER_FLAG_IS_SET(gst_sample_get_buffer(sample), GST_BUFFER_FLAG_CORRUPTED);
    if (const auto record = telemetry_of(gst_sample_get_buffer(sample)))
      frame.telemetry = {camera_clock_.to_host(record->made_at, now), *record};
    tap_.note(frame, time);
    if (pace_ == Pace::kAsTaken) return exchange_.offer_and_wait(std::move(frame));
    exchange_.offer(std::move(frame));
    return true;
  }

  const Pace pace_;
  std::optional<HostTime> starts_at_;  // set by the constructor or by the first frame
  const VideoConfig config_;
  const HostClock& clock_;
  PictureTap tap_;
  CameraClock camera_clock_;
  FrameExchange exchange_;
  mutable std::mutex tags_mutex_;
  std::optional<HostTime> created_at_;  // guarded by tags_mutex_
  GstElement* converter_ = nullptr;     // owned by the pipeline
  GstPipelinePtr pipeline_;             // last: its threads end before what they use
};

FileSource::FileSource(const std::filesystem::path& file, const Playback& playback, const VideoConfig& config,
                       const HostClock& clock, std::shared_ptr<EncodedVideoTaker> taker)
    : impl_(std::make_unique<Impl>(file, playback, config, clock, std::move(taker))) {}

FileSource::~FileSource() = default;

std::optional<VideoFrame> FileSource::next(Duration timeout) {
  return impl_->next(timeout);
}

std::vector<FrameTelemetry> FileSource::take_telemetry() {
  return impl_->take_telemetry();
}

VideoStatus FileSource::status() const {
  return impl_->status();
}

FileFacts FileSource::facts() const {
  return impl_->facts();
}

}  // namespace geoloc::io
