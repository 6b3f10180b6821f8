// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/rtsp/rtsp_camera.hpp"

#include <gst/app/gstappsrc.h>
#include <gst/rtsp-server/rtsp-server.h>

#include <cmath>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "geoloc/geometry/problems.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "io/gst/gst_handles.hpp"
#include "io/video/sei_buffer.hpp"

namespace geoloc::sim {
namespace {

constexpr const char* kAddress = "127.0.0.1";
constexpr const char* kPath = "/cam";

using io::GObjectPtr;
using io::GstObjectPtr;
using io::Releaser;
using ContextPtr = std::unique_ptr<GMainContext, Releaser<g_main_context_unref>>;
using SourcePtr = std::unique_ptr<GSource, Releaser<g_source_unref>>;
using LoopPtr = std::unique_ptr<GMainLoop, Releaser<g_main_loop_unref>>;

/// One key frame a second: a receiver that joins or loses a packet waits no longer than that. zerolatency: no
/// frame is held back by the encoder.
std::string launch_line(const RtspCameraSettings& settings) {
  gint numerator = 0, denominator = 1;
  gst_util_double_to_fraction(settings.frame_rate_hz, &numerator, &denominator);
  return "( appsrc name=source is-live=true format=time block=false max-buffers=2 leaky-type=downstream "
         "caps=video/x-raw,format=BGR,width=" +
         std::to_string(settings.width_px) + ",height=" + std::to_string(settings.height_px) +
         ",framerate=" + std::to_string(numerator) + "/" + std::to_string(denominator) +
         " ! videoconvert ! video/x-raw,format=I420"
         " ! x264enc name=encoder tune=zerolatency speed-preset=ultrafast bitrate=" +
         std::to_string(settings.bitrate_kbps) +
         " key-int-max=" + std::to_string(std::max(1L, std::lround(settings.frame_rate_hz))) +
         " ! video/x-h264,stream-format=byte-stream,alignment=au ! h264parse config-interval=-1"
         " ! rtph264pay name=pay0 pt=96 config-interval=0 )";
}

/// Sender reports are to tell when a picture was taken; by default they tell when its packets are sent.
gboolean report_capture_times(GstRTSPMedia* /*media*/, GstElement* rtpbin) {
  g_object_set(rtpbin, "rtcp-sync-send-time", FALSE, nullptr);
  return TRUE;
}

GType capture_time_media_type() {
  static const GType type = g_type_register_static_simple(
      GST_TYPE_RTSP_MEDIA, "GeolocSimMedia", sizeof(GstRTSPMediaClass),
      [](gpointer media_class, gpointer) {
        static_cast<GstRTSPMediaClass*>(media_class)->setup_rtpbin = report_capture_times;
      },
      sizeof(GstRTSPMedia), nullptr, static_cast<GTypeFlags>(0));
  return type;
}

/// Reports every second or so, where the default is five: a receiver knows the capture time only from its
/// second report.
void report_often(GstRTSPMedia* media, gpointer /*user*/) {
  for (guint i = 0; i < gst_rtsp_media_n_streams(media); ++i) {
    const GObjectPtr<GObject> session(gst_rtsp_stream_get_rtpsession(gst_rtsp_media_get_stream(media, i)));
    if (session) g_object_set(session.get(), "rtcp-min-interval", guint64{GST_SECOND}, nullptr);
  }
}

}  // namespace

/// The server with the thread of its main loop, and the source that the pipeline of the moment takes pictures
/// from.
struct RtspCamera::Server {
  explicit Server(const RtspCameraSettings& settings);
  ~Server();

  static void on_media_configured(GstRTSPMediaFactory* factory, GstRTSPMedia* media, Server* self);
  static void on_media_unprepared(GstRTSPMedia* media, Server* self);
  GstObjectPtr<GstElement> playing_source();

  RtspCameraSettings settings;
  ContextPtr context{g_main_context_new()};
  LoopPtr loop{g_main_loop_new(context.get(), FALSE)};
  GObjectPtr<GstRTSPServer> server{gst_rtsp_server_new()};
  SourcePtr listener;
  SourcePtr housekeeping;
  std::thread thread;

  std::mutex mutex;
  GstRTSPMedia* media = nullptr;  // of which `source` is; guarded by the mutex, as that is
  GstObjectPtr<GstElement> source;
};

RtspCamera::Server::Server(const RtspCameraSettings& wanted) : settings(wanted) {
  gst_rtsp_server_set_address(server.get(), kAddress);
  gst_rtsp_server_set_service(server.get(), std::to_string(settings.port).c_str());

  GstRTSPMediaFactory* const factory = gst_rtsp_media_factory_new();  // the mount points take it over
  gst_rtsp_media_factory_set_launch(factory, launch_line(settings).c_str());
  gst_rtsp_media_factory_set_shared(factory, TRUE);
  gst_rtsp_media_factory_set_latency(factory, 0);
  gst_rtsp_media_factory_set_media_gtype(factory, capture_time_media_type());
  const GstObjectPtr<GstClock> monotonic(gst_system_clock_obtain());  // the clock that push() stamps with
  gst_rtsp_media_factory_set_clock(factory, monotonic.get());
  g_signal_connect(factory, "media-configure", G_CALLBACK(on_media_configured), this);
  const GObjectPtr<GstRTSPMountPoints> mounts(gst_rtsp_server_get_mount_points(server.get()));
  gst_rtsp_mount_points_add_factory(mounts.get(), kPath, factory);

  GError* error = nullptr;
  listener.reset(gst_rtsp_server_create_source(server.get(), nullptr, &error));
  if (!listener) {
    const std::string reason = error != nullptr ? error->message : "unknown reason";
    g_clear_error(&error);
    throw std::runtime_error("--rtsp-port " + std::to_string(settings.port) + ": cannot listen on " +
                             kAddress + ": " + reason + "; choose another port");
  }
  g_source_attach(listener.get(), context.get());

  constexpr guint kHousekeepingPeriod_s = 2;  // forgets clients that went without a word
  housekeeping.reset(g_timeout_source_new_seconds(kHousekeepingPeriod_s));
  const GSourceFunc forget_lost_clients = [](gpointer rtsp_server) -> gboolean {
    const GObjectPtr<GstRTSPSessionPool> pool(gst_rtsp_server_get_session_pool(GST_RTSP_SERVER(rtsp_server)));
    gst_rtsp_session_pool_cleanup(pool.get());
    return G_SOURCE_CONTINUE;
  };
  g_source_set_callback(housekeeping.get(), forget_lost_clients, server.get(), nullptr);
  g_source_attach(housekeeping.get(), context.get());
  thread = std::thread([this] {
    g_main_context_push_thread_default(context.get());
    g_main_loop_run(loop.get());
    g_main_context_pop_thread_default(context.get());
  });
}

RtspCamera::Server::~Server() {
  const auto remove = [](GstRTSPServer*, GstRTSPClient*, gpointer) { return GST_RTSP_FILTER_REMOVE; };
  gst_rtsp_server_client_filter(server.get(), remove, nullptr);
  // Quit from within: a loop that has not begun to run yet forgets that it was told to.
  const SourcePtr quit(g_idle_source_new());
  const GSourceFunc quit_loop = [](gpointer main_loop) -> gboolean {
    g_main_loop_quit(static_cast<GMainLoop*>(main_loop));
    return G_SOURCE_REMOVE;
  };
  g_source_set_callback(quit.get(), quit_loop, loop.get(), nullptr);
  g_source_attach(quit.get(), context.get());
  thread.join();
  g_source_destroy(listener.get());
  g_source_destroy(housekeeping.get());
}

void RtspCamera::Server::on_media_configured(GstRTSPMediaFactory* /*factory*/, GstRTSPMedia* media,
                                             Server* self) {
  const GstObjectPtr<GstElement> pipeline(gst_rtsp_media_get_element(media));
  const GstObjectPtr<GstElement> encoder(gst_bin_get_by_name(GST_BIN(pipeline.get()), "encoder"));
  const GstObjectPtr<GstPad> encoded(gst_element_get_static_pad(encoder.get(), "src"));
  io::write_telemetry_at(encoded.get());
  g_signal_connect(media, "prepared", G_CALLBACK(report_often), nullptr);
  g_signal_connect(media, "unprepared", G_CALLBACK(on_media_unprepared), self);
  const std::lock_guard<std::mutex> lock(self->mutex);
  self->media = media;
  self->source.reset(gst_bin_get_by_name_recurse_up(GST_BIN(pipeline.get()), "source"));
}

void RtspCamera::Server::on_media_unprepared(GstRTSPMedia* media, Server* self) {
  const std::lock_guard<std::mutex> lock(self->mutex);
  if (self->media != media) return;  // the next one is already there
  self->media = nullptr;
  self->source.reset();
}

GstObjectPtr<GstElement> RtspCamera::Server::playing_source() {
  const std::lock_guard<std::mutex> lock(mutex);
  if (!source || GST_STATE(source.get()) != GST_STATE_PLAYING) return nullptr;
  return GstObjectPtr<GstElement>(GST_ELEMENT(gst_object_ref(source.get())));
}

std::vector<std::string> RtspCameraSettings::problems() const {
  Problems found;
  const auto is_size = [](int value_px) { return value_px >= 16 && value_px <= 8192 && value_px % 2 == 0; };
  found.require(is_size(width_px), "rtsp.width must be even and lie in [16, 8192] px");
  found.require(is_size(height_px), "rtsp.height must be even and lie in [16, 8192] px");
  found.require(frame_rate_hz > 0.0 && frame_rate_hz <= 240.0, "rtsp.frame_rate must lie in (0, 240] Hz");
  found.require(bitrate_kbps > 0 && bitrate_kbps <= 1'000'000,
                "rtsp.bitrate must lie in [1, 1000000] kbit/s");
  return found.take();
}

RtspCamera::RtspCamera(const RtspCameraSettings& settings) {
  refuse_if_any(settings.problems());
  gst_init(nullptr, nullptr);
  for (const char* const needed : {"appsrc", "videoconvert", "x264enc", "h264parse", "rtph264pay"}) {
    const GstObjectPtr<GstElementFactory> factory(gst_element_factory_find(needed));
    if (factory) continue;
    throw std::runtime_error(std::string("GStreamer has no ") + needed +
                             ": apt-get install gstreamer1.0-plugins-base gstreamer1.0-plugins-good "
                             "gstreamer1.0-plugins-bad gstreamer1.0-plugins-ugly");
  }
  server_ = std::make_unique<Server>(settings);
}

RtspCamera::~RtspCamera() = default;

std::string RtspCamera::url() const {
  const int port = gst_rtsp_server_get_bound_port(server_->server.get());
  return std::string("rtsp://") + kAddress + ":" + std::to_string(port) + kPath;
}

bool RtspCamera::is_watched() const {
  return server_->playing_source() != nullptr;
}

bool RtspCamera::push(const std::uint8_t* bgr, std::chrono::steady_clock::time_point stamp,
                      const std::optional<io::VideoTelemetry>& telemetry) {
  const GstObjectPtr<GstElement> source = server_->playing_source();
  if (!source) return false;
  // GStreamer's system clock and steady_clock are the same clock of the kernel, so the stamp needs no second
  // reading.
  const auto since_start = std::chrono::nanoseconds(stamp.time_since_epoch()).count() -
                           static_cast<std::int64_t>(gst_element_get_base_time(source.get()));
  if (since_start < 0) return false;
  const gsize size = gsize{3} * static_cast<gsize>(server_->settings.width_px) *
                     static_cast<gsize>(server_->settings.height_px);
  GstBuffer* const buffer = gst_buffer_new_allocate(nullptr, size, nullptr);
  gst_buffer_fill(buffer, 0, bgr, size);
  GST_BUFFER_PTS(buffer) = static_cast<GstClockTime>(since_start);
  if (telemetry) io::attach_telemetry(buffer, io::to_json(*telemetry));
  return gst_app_src_push_buffer(GST_APP_SRC(source.get()), buffer) == GST_FLOW_OK;
}

}  // namespace geoloc::sim
