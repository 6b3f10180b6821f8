// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gio/gio.h>
#include <gst/app/gstappsink.h>

#include <atomic>
#include <string>

#include "geoloc/io/host_clock.hpp"
#include "geoloc/io/video/camera_clock.hpp"
#include "geoloc/io/video/frame_exchange.hpp"
#include "geoloc/io/video/rtp_payload.hpp"
#include "geoloc/io/video/video_config.hpp"
#include "io/gst/gst_handles.hpp"
#include "picture_tap.hpp"
#include "stream_relay.hpp"
#include "stream_timing.hpp"

namespace geoloc::io {

/// Throws std::runtime_error naming the element and its package if a GStreamer element is missing.
void require_rtsp_elements();

/// One connection to a server, through a relay: rtspsrc ! depayloader ! parser ! decoder ! videoconvert !
/// appsink. Frames go to the exchange with their capture time. Every callback runs in a thread of
/// GStreamer's, which ends with the pipeline.
class RtspSession {
 public:
  /// Begins to connect. Everything passed by reference must outlive the session. The encoded pictures go to
  /// the tap, too.
  RtspSession(const std::string& url, const VideoConfig& config, const HostClock& clock,
              CameraClock& camera_clock, FrameExchange& exchange, PictureTap tap);
  /// Takes a moment, whatever the server does.
  ~RtspSession();
  RtspSession(const RtspSession&) = delete;
  RtspSession& operator=(const RtspSession&) = delete;

  /// Returns the reason why the connection ended, or an empty text if `stop` was set.
  std::string wait_until_over(const std::atomic<bool>& stop) const;

  bool has_delivered() const { return has_delivered_; }

  /// The connection was given up because of what the server sent.
  bool is_server_at_fault() const;

 private:
  struct Format;
  static const Format* format_for(GstCaps* caps);

  static void on_manager(GstElement*, GstElement* manager, gpointer self);
  static void on_jitter_buffer(GstElement*, GstElement* buffer, guint, guint, gpointer self);
  static void on_report(GstElement*, GstStructure* report, gpointer self);
  static gboolean on_certificate(GstElement*, GTlsConnection*, GTlsCertificate* certificate,
                                 GTlsCertificateFlags faults, gpointer self);
  static gboolean on_select_stream(GstElement*, guint, GstCaps* caps, gpointer self);
  static void on_pad(GstElement*, GstPad* pad, gpointer self);
  static GstPadProbeReturn on_packets(GstPad*, GstPadProbeInfo* info, gpointer self);
  static GstPadProbeReturn on_parsed(GstPad* pad, GstPadProbeInfo* info, gpointer self);
  static GstFlowReturn on_sample(GstAppSink* sink, gpointer self);

  void build_decoder(GstPad* stream);
  void observe_packet(GstBuffer** packet);
  void deliver(GstSample* sample);

  const VideoConfig& config_;
  const HostClock& clock_;
  CameraClock& camera_clock_;  // used where frames are delivered
  FrameExchange& exchange_;
  PictureTap tap_;

  std::atomic<bool> has_selected_{false};
  std::atomic<bool> is_too_large_{false};
  std::atomic<bool> has_delivered_{false};
  std::atomic<HostTime> alive_at_;  // of the last frame, or of the beginning
  std::atomic<VideoCodec> codec_{VideoCodec::kH264};
  StreamTiming timing_;

  StreamRelay relay_;
  GstElement* converter_ = nullptr;  // owned by the pipeline
  GstPipelinePtr pipeline_;          // last: its threads end before what they use
};

}  // namespace geoloc::io
