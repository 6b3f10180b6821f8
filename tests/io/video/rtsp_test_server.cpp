// SPDX-License-Identifier: Apache-2.0
#include "rtsp_test_server.hpp"

#include <gst/rtsp-server/rtsp-server.h>
#include <gst/video/video.h>

#include <atomic>
#include <chrono>
#include <future>
#include <stdexcept>
#include <thread>

#include "time_stamp_picture.hpp"

namespace geoloc::io::test {
namespace {

/// Without this, a GStreamer server shifts its reports by the latency of its pipeline. The only hook for it
/// is in the class of the media.
struct HonestMedia {
  GstRTSPMedia parent;
};
struct HonestMediaClass {
  GstRTSPMediaClass parent;
};
G_DEFINE_TYPE(HonestMedia, honest_media, GST_TYPE_RTSP_MEDIA)

gboolean setup_rtpbin(GstRTSPMedia*, GstElement* rtpbin) {
  g_object_set(rtpbin, "rtcp-sync-send-time", FALSE, nullptr);
  return TRUE;
}
void honest_media_class_init(HonestMediaClass* kind) {
  kind->parent.setup_rtpbin = setup_rtpbin;
}
void honest_media_init(HonestMedia*) {}

struct BootClockMedia {
  HonestMedia parent;
};
struct BootClockMediaClass {
  HonestMediaClass parent;
};
G_DEFINE_TYPE(BootClockMedia, boot_clock_media, honest_media_get_type())

gboolean setup_boot_clock(GstRTSPMedia* media, GstElement* rtpbin) {
  gst_util_set_object_arg(G_OBJECT(rtpbin), "ntp-time-source", "running-time");
  return setup_rtpbin(media, rtpbin);
}
void boot_clock_media_class_init(BootClockMediaClass* kind) {
  kind->parent.parent.setup_rtpbin = setup_boot_clock;
}
void boot_clock_media_init(BootClockMedia*) {}

std::string size_caps(int width_px, int height_px) {
  return "video/x-raw,format=I420,framerate=20/1,width=" + std::to_string(width_px) +
         ",height=" + std::to_string(height_px);
}

}  // namespace

class RtspTestServer::Impl {
 public:
  Impl(const ServerOptions& options, const HostClock& clock)
      : clock_(clock), context_(g_main_context_new()), loop_(g_main_loop_new(context_, FALSE)) {
    gst_init(nullptr, nullptr);
    server_ = gst_rtsp_server_new();
    gst_rtsp_server_set_address(server_, "127.0.0.1");
    gst_rtsp_server_set_service(server_, std::to_string(options.port).c_str());
    mount(options);
    source_ = gst_rtsp_server_create_source(server_, nullptr, nullptr);
    if (source_ == nullptr) throw std::runtime_error("the test server gets no port");
    g_source_attach(source_, context_);
    thread_ = std::thread{[this] { g_main_loop_run(loop_); }};
  }

  ~Impl() {
    const auto close_all = [](gpointer self) -> gboolean {
      const auto remove = [](GstRTSPServer*, GstRTSPClient*, gpointer) { return GST_RTSP_FILTER_REMOVE; };
      gst_rtsp_server_client_filter(static_cast<Impl*>(self)->server_, remove, nullptr);
      g_main_loop_quit(static_cast<Impl*>(self)->loop_);
      return G_SOURCE_REMOVE;
    };
    g_main_context_invoke(context_, close_all, this);
    thread_.join();
    while (g_main_context_iteration(context_, FALSE) != FALSE) {
    }
    g_source_destroy(source_);
    g_source_unref(source_);
    g_object_unref(server_);
    g_main_loop_unref(loop_);
    g_main_context_unref(context_);
  }

  std::uint16_t port() const { return static_cast<std::uint16_t>(gst_rtsp_server_get_bound_port(server_)); }

  std::atomic<bool> frozen{false};
  std::atomic<int> to_lose{0};
  std::atomic<int> width_px{0};
  std::atomic<int> height_px{0};

 private:
  void mount(const ServerOptions& options) {
    const std::string launch = "( videotestsrc is-live=true pattern=ball ! capsfilter name=size caps=" +
                               size_caps(options.width_px, options.height_px) + " ! " + options.encoder +
                               " name=pay0 pt=96 )";
    GstRTSPMediaFactory* factory = gst_rtsp_media_factory_new();
    gst_rtsp_media_factory_set_launch(factory, launch.c_str());
    gst_rtsp_media_factory_set_shared(factory, TRUE);
    gst_rtsp_media_factory_set_latency(factory, 0);
    gst_rtsp_media_factory_set_media_gtype(
        factory, options.has_utc ? honest_media_get_type() : boot_clock_media_get_type());
    g_signal_connect(factory, "media-configure", G_CALLBACK(on_media), this);
    GstRTSPMountPoints* mounts = gst_rtsp_server_get_mount_points(server_);
    gst_rtsp_mount_points_add_factory(mounts, "/camera", factory);
    g_object_unref(mounts);
  }

  static void on_media(GstRTSPMediaFactory*, GstRTSPMedia* media, gpointer self) {
    GstElement* bin = gst_rtsp_media_get_element(media);
    const auto probe = [bin, self](const char* element_name, GstPadProbeCallback callback) {
      GstElement* element = gst_bin_get_by_name_recurse_up(GST_BIN(bin), element_name);
      GstPad* pad = gst_element_get_static_pad(element, "src");
      constexpr auto kTypes =
          static_cast<GstPadProbeType>(GST_PAD_PROBE_TYPE_BUFFER | GST_PAD_PROBE_TYPE_BUFFER_LIST);
      gst_pad_add_probe(pad, kTypes, callback, self, nullptr);
      gst_object_unref(pad);
      gst_object_unref(element);
    };
    probe("size", on_picture);
    probe("pay0", on_packets);
    gst_object_unref(bin);
    g_signal_connect(media, "prepared", G_CALLBACK(on_prepared), nullptr);
  }

  static void on_prepared(GstRTSPMedia* media, gpointer) {
    GObject* session = gst_rtsp_stream_get_rtpsession(gst_rtsp_media_get_stream(media, 0));
    g_object_set(session, "rtcp-min-interval", static_cast<guint64>(200 * GST_MSECOND), nullptr);
    g_object_unref(session);
  }

  static GstPadProbeReturn on_picture(GstPad* pad, GstPadProbeInfo* info, gpointer self) {
    Impl& here = *static_cast<Impl*>(self);
    GstElement* filter = gst_pad_get_parent_element(pad);
    here.stamp(filter, pad, gst_buffer_make_writable(GST_PAD_PROBE_INFO_BUFFER(info)), info);
    if (const int width = here.width_px.exchange(0); width > 0) {
      gst_util_set_object_arg(G_OBJECT(filter), "caps", size_caps(width, here.height_px).c_str());
    }
    gst_object_unref(filter);
    return GST_PAD_PROBE_OK;
  }

  /// The truth is the picture's time on the pipeline's clock, which is the monotonic one: exact even on a
  /// slow machine.
  void stamp(GstElement* element, GstPad* pad, GstBuffer* buffer, GstPadProbeInfo* info) const {
    GST_PAD_PROBE_INFO_DATA(info) = buffer;
    const std::chrono::nanoseconds on_clock{gst_element_get_base_time(element) + GST_BUFFER_PTS(buffer)};
    const HostTime truth = clock_.at(std::chrono::steady_clock::time_point{on_clock});
    GstCaps* caps = gst_pad_get_current_caps(pad);
    GstVideoInfo video;
    GstVideoFrame frame;
    if (gst_video_info_from_caps(&video, caps) != FALSE &&
        gst_video_frame_map(&frame, &video, buffer, GST_MAP_WRITE) != FALSE) {
      draw_number(static_cast<std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&frame, 0)),
                  static_cast<std::size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&frame, 0)),
                  static_cast<std::uint64_t>(truth.time_since_epoch().count()));
      gst_video_frame_unmap(&frame);
    }
    gst_caps_unref(caps);
  }

  static GstPadProbeReturn on_packets(GstPad*, GstPadProbeInfo* info, gpointer self) {
    Impl& here = *static_cast<Impl*>(self);
    if (here.frozen) return GST_PAD_PROBE_DROP;
    if (here.to_lose <= 0) return GST_PAD_PROBE_OK;
    const bool is_list = (info->type & GST_PAD_PROBE_TYPE_BUFFER_LIST) != 0;
    here.to_lose -=
        is_list ? static_cast<int>(gst_buffer_list_length(GST_PAD_PROBE_INFO_BUFFER_LIST(info))) : 1;
    return GST_PAD_PROBE_DROP;
  }

  const HostClock& clock_;
  GMainContext* context_;
  GMainLoop* loop_;
  GstRTSPServer* server_ = nullptr;
  GSource* source_ = nullptr;
  std::thread thread_;
};

RtspTestServer::RtspTestServer(const ServerOptions& options, const HostClock& clock)
    : impl_(std::make_unique<Impl>(options, clock)) {}

RtspTestServer::~RtspTestServer() = default;

std::uint16_t RtspTestServer::port() const {
  return impl_->port();
}

std::string RtspTestServer::url() const {
  return "rtsp://127.0.0.1:" + std::to_string(port()) + "/camera";
}

void RtspTestServer::freeze(bool frozen) {
  impl_->frozen = frozen;
}

void RtspTestServer::lose_packets(int count) {
  impl_->to_lose = count;
}

void RtspTestServer::resize(int width_px, int height_px) {
  impl_->height_px = height_px;
  impl_->width_px = width_px;
}

std::optional<HostTime> stamped_time(const cv::Mat& bgr) {
  if (bgr.cols < kCellsPerRow * kCellPx || bgr.rows < kCells / kCellsPerRow * kCellPx) return std::nullopt;
  std::uint64_t value = 0;
  std::uint8_t check = 0;
  for (int cell = 0; cell < kCells; ++cell) {
    const int row = cell / kCellsPerRow * kCellPx + kCellPx / 2;
    const int column = cell % kCellsPerRow * kCellPx + kCellPx / 2;
    const bool bit = bgr.at<cv::Vec3b>(row, column)[1] > 127;
    if (bit && cell < 64) value |= std::uint64_t{1} << cell;
    if (bit && cell >= 64) check = static_cast<std::uint8_t>(check | 1U << (cell - 64));
  }
  if (check != check_byte(value)) return std::nullopt;
  return HostTime{Duration{static_cast<std::int64_t>(value)}};
}

}  // namespace geoloc::io::test
