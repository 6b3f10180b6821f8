// SPDX-License-Identifier: Apache-2.0
#include "rtsp_session.hpp"

#include <gst/rtp/rtp.h>

#include <algorithm>
#include <array>
#include <exception>
#include <string_view>

#include "gst_pipeline.hpp"
#include "io/gst/gst_elements.hpp"
#include "rtcp_report.hpp"
#include "sei_buffer.hpp"

namespace geoloc::io {

struct RtspSession::Format {
  VideoCodec codec;
  std::string_view encoding;  ///< its name in a session description
  const char* depayloader;
  const char* parser;
  const char* decoder;
};

namespace {

/// The RTP timestamp travels with the picture: this meta survives depayloader, parser, decoder and converter.
/// A map from presentation times would not work, because the jitter buffer may give several frames of a burst
/// the same one.
GstCaps* rtp_timestamp_caps() {
  static GstCaps* const caps = gst_caps_new_empty_simple("timestamp/x-geoloc-rtp");
  return caps;
}

std::optional<std::uint32_t> rtp_timestamp(GstBuffer* buffer) {
  const auto* meta = gst_buffer_get_reference_timestamp_meta(buffer, rtp_timestamp_caps());
  return meta != nullptr ? std::optional{static_cast<std::uint32_t>(meta->timestamp)} : std::nullopt;
}

RtspSession* session(gpointer self) {
  return static_cast<RtspSession*>(self);
}

GstElement* add_rtspsrc(GstElement* pipeline, const std::string& url, const VideoConfig& config,
                        const std::string& proxy) {
  constexpr guint kUdp = 1U << 0U;  // of GstRTSPLowerTrans
  constexpr guint kTcp = 1U << 2U;
  const auto timeout_us = static_cast<guint64>(config.connect_timeout_s * 1e6);
  GstElement* source = add_element(pipeline, "rtspsrc");
  g_object_set(source, "location", url.c_str(), "proxy", proxy.c_str(), "protocols",
               config.transport == RtspTransport::kTcp ? kTcp : kUdp, "latency",
               static_cast<guint>(config.reorder_s * 1e3), "drop-on-latency", TRUE, "tcp-timeout", timeout_us,
               "timeout", timeout_us, "udp-reconnect", FALSE, "teardown-timeout",
               static_cast<guint64>(50 * GST_MSECOND), nullptr);
  return source;
}

/// The error, if the pipeline reports one within the wait.
std::optional<std::string> failure(GstElement* pipeline, GstClockTime wait) {
  const GstObjectPtr<GstBus> bus{gst_element_get_bus(pipeline)};
  const auto types = static_cast<GstMessageType>(GST_MESSAGE_ERROR | GST_MESSAGE_EOS);
  const GstMessagePtr message{gst_bus_timed_pop_filtered(bus.get(), wait, types)};
  if (!message) return std::nullopt;
  return GST_MESSAGE_TYPE(message.get()) == GST_MESSAGE_EOS ? "the server ended the stream"
                                                            : error_text(message.get());
}

std::string no_frame_text(double timeout_s) {
  std::string number = std::to_string(timeout_s);
  number.erase(number.find_last_not_of('0') + 1);
  if (number.back() == '.') number.pop_back();
  return "no frame for " + number + " s";
}

}  // namespace

const RtspSession::Format* RtspSession::format_for(GstCaps* caps) {
  static constexpr std::array<Format, 2> kFormats{
      Format{VideoCodec::kH264, "H264", "rtph264depay", "h264parse", "avdec_h264"},
      Format{VideoCodec::kH265, "H265", "rtph265depay", "h265parse", "avdec_h265"}};
  const GstStructure* stream = gst_caps_is_empty(caps) == FALSE ? gst_caps_get_structure(caps, 0) : nullptr;
  const char* encoding = stream != nullptr ? gst_structure_get_string(stream, "encoding-name") : nullptr;
  if (encoding == nullptr) return nullptr;
  const auto* format = std::find_if(kFormats.begin(), kFormats.end(),
                                    [encoding](const Format& known) { return known.encoding == encoding; });
  return format != kFormats.end() && has_element(format->decoder) ? format : nullptr;
}

void require_rtsp_elements() {
  for (const char* name : {"rtspsrc", "rtph264depay", "rtpjitterbuffer"})
    require_element(name, "gstreamer1.0-plugins-good");
  require_element("h264parse", "gstreamer1.0-plugins-bad");
  require_element("avdec_h264", "gstreamer1.0-libav");
  for (const char* name : {"videoconvert", "appsink"}) require_element(name, "gstreamer1.0-plugins-base");
}

RtspSession::RtspSession(const std::string& url, const VideoConfig& config, const HostClock& clock,
                         CameraClock& camera_clock, FrameExchange& exchange, PictureTap tap)
    : config_(config),
      clock_(clock),
      camera_clock_(camera_clock),
      exchange_(exchange),
      tap_(std::move(tap)),
      alive_at_(clock.now()),
      timing_(from_seconds(config.latency_s)),
      relay_(url, config.transport),
      pipeline_(gst_pipeline_new(nullptr)) {
  GstElement* source = add_rtspsrc(pipeline_.get(), url, config, relay_.address());
  g_signal_connect(source, "accept-certificate", G_CALLBACK(on_certificate), this);
  g_signal_connect(source, "new-manager", G_CALLBACK(on_manager), this);
  g_signal_connect(source, "select-stream", G_CALLBACK(on_select_stream), this);
  g_signal_connect(source, "pad-added", G_CALLBACK(on_pad), this);

  converter_ = add_element(pipeline_.get(), "videoconvert");
  GstAppSinkCallbacks callbacks{};
  callbacks.new_sample = on_sample;
  GstElement* sink = add_bgr_sink(pipeline_.get(), callbacks, this);
  g_object_set(sink, "sync", FALSE, "drop", TRUE, nullptr);
  gst_element_link(converter_, sink);
  gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING);
}

/// A server that answers in time is told that this is the end.
RtspSession::~RtspSession() {
  relay_.cut_within(std::chrono::milliseconds{200});
}

bool RtspSession::is_server_at_fault() const {
  const auto end = relay_.end();
  return end && end->is_server_at_fault;
}

std::string RtspSession::wait_until_over(const std::atomic<bool>& stop) const {
  while (!stop) {
    const auto fault = failure(pipeline_.get(), 50 * GST_MSECOND);
    if (const auto end = relay_.end()) return end->why;  // of which the fault is a consequence
    if (fault) return *fault;
    const double timeout_s = has_delivered_ ? config_.frame_timeout_s : config_.connect_timeout_s;
    if (seconds(clock_.now() - alive_at_.load()) > timeout_s) return no_frame_text(timeout_s);
  }
  return {};
}

void RtspSession::on_manager(GstElement*, GstElement* manager, gpointer self) {
  g_signal_connect(manager, "new-jitterbuffer", G_CALLBACK(on_jitter_buffer), self);
}

void RtspSession::on_jitter_buffer(GstElement*, GstElement* buffer, guint, guint, gpointer self) {
  g_signal_connect(buffer, "handle-sync", G_CALLBACK(on_report), self);
}

void RtspSession::on_report(GstElement*, GstStructure* sync, gpointer self) {
  if (const auto report = sender_report(sync)) session(self)->timing_.observe(*report);
}

/// The name that GIO compares with the certificate's is that of the relay; the server's is compared here.
gboolean RtspSession::on_certificate(GstElement*, GTlsConnection*, GTlsCertificate* certificate,
                                     GTlsCertificateFlags faults, gpointer self) {
  if ((faults & ~static_cast<unsigned>(G_TLS_CERTIFICATE_BAD_IDENTITY)) != 0) return FALSE;
  return g_tls_certificate_verify(certificate, session(self)->relay_.server(), nullptr) == 0 ? TRUE : FALSE;
}

/// Selects the first stream that can be decoded: cameras list the main one first.
gboolean RtspSession::on_select_stream(GstElement*, guint, GstCaps* caps, gpointer self) {
  if (format_for(caps) == nullptr) return FALSE;
  return session(self)->has_selected_.exchange(true) ? FALSE : TRUE;
}

void RtspSession::on_pad(GstElement*, GstPad* pad, gpointer self) {
  try {
    session(self)->build_decoder(pad);
  } catch (const std::exception& error) {
    session(self)->exchange_.report_error(error.what());
  }
}

void RtspSession::build_decoder(GstPad* stream) {
  const GstCapsPtr caps{gst_pad_get_current_caps(stream)};
  const Format* format = caps ? format_for(caps.get()) : nullptr;
  const GstObjectPtr<GstPad> converter_pad{gst_element_get_static_pad(converter_, "sink")};
  if (format == nullptr || gst_pad_is_linked(converter_pad.get()) != FALSE) return;
  codec_ = format->codec;
  GstElement* depayloader = add_element(pipeline_.get(), format->depayloader);
  GstElement* parser = add_element(pipeline_.get(), format->parser);
  GstElement* decoder = add_element(pipeline_.get(), format->decoder);
  gst_element_link_many(depayloader, parser, decoder, converter_, nullptr);

  const GstObjectPtr<GstPad> parsed{gst_element_get_static_pad(parser, "src")};
  gst_pad_add_probe(
      parsed.get(),
      static_cast<GstPadProbeType>(GST_PAD_PROBE_TYPE_EVENT_DOWNSTREAM | GST_PAD_PROBE_TYPE_BUFFER),
      on_parsed, this, nullptr);
  if (codec_ == VideoCodec::kH265) read_telemetry_at(parsed.get());
  tap_.open_at(parsed.get());
  gst_pad_add_probe(stream,
                    static_cast<GstPadProbeType>(GST_PAD_PROBE_TYPE_BUFFER | GST_PAD_PROBE_TYPE_BUFFER_LIST),
                    on_packets, this, nullptr);
  for (GstElement* element : {decoder, parser, depayloader}) gst_element_sync_state_with_parent(element);
  const GstObjectPtr<GstPad> packets{gst_element_get_static_pad(depayloader, "sink")};
  gst_pad_link(stream, packets.get());
}

GstPadProbeReturn RtspSession::on_packets(GstPad*, GstPadProbeInfo* info, gpointer self) {
  if ((info->type & GST_PAD_PROBE_TYPE_BUFFER_LIST) != 0) {
    GstBufferList* list = gst_buffer_list_make_writable(GST_PAD_PROBE_INFO_BUFFER_LIST(info));
    const auto observe = [](GstBuffer** packet, guint, gpointer user) -> gboolean {
      session(user)->observe_packet(packet);
      return TRUE;
    };
    gst_buffer_list_foreach(list, observe, self);
    GST_PAD_PROBE_INFO_DATA(info) = list;
  } else {
    GstBuffer* packet = GST_PAD_PROBE_INFO_BUFFER(info);
    session(self)->observe_packet(&packet);
    GST_PAD_PROBE_INFO_DATA(info) = packet;
  }
  return GST_PAD_PROBE_OK;
}

void RtspSession::observe_packet(GstBuffer** packet) {
  GstRTPBuffer rtp = GST_RTP_BUFFER_INIT;
  if (gst_rtp_buffer_map(*packet, GST_MAP_READ, &rtp) == FALSE) return;
  const auto* payload = static_cast<const std::uint8_t*>(gst_rtp_buffer_get_payload(&rtp));
  const RtpPacket seen{gst_rtp_buffer_get_seq(&rtp), gst_rtp_buffer_get_timestamp(&rtp),
                       begins_random_access_picture(codec_, payload, gst_rtp_buffer_get_payload_len(&rtp))};
  gst_rtp_buffer_unmap(&rtp);
  exchange_.count_packet(timing_.observe(seen, clock_.now()));
  *packet = gst_buffer_make_writable(*packet);
  gst_buffer_add_reference_timestamp_meta(*packet, rtp_timestamp_caps(), seen.timestamp, GST_CLOCK_TIME_NONE);
}

/// Ends the session before the decoder makes room for a picture of absurd size.
GstPadProbeReturn RtspSession::on_parsed(GstPad* pad, GstPadProbeInfo* info, gpointer self) {
  RtspSession& here = *session(self);
  if ((info->type & GST_PAD_PROBE_TYPE_BUFFER) != 0)
    return here.is_too_large_ ? GST_PAD_PROBE_DROP : GST_PAD_PROBE_OK;
  GstEvent* event = GST_PAD_PROBE_INFO_EVENT(info);
  if (GST_EVENT_TYPE(event) != GST_EVENT_CAPS) return GST_PAD_PROBE_OK;

  GstCaps* caps = nullptr;
  gst_event_parse_caps(event, &caps);
  int width_px = 0;
  int height_px = 0;
  gst_structure_get(gst_caps_get_structure(caps, 0), "width", G_TYPE_INT, &width_px, "height", G_TYPE_INT,
                    &height_px, nullptr);
  if (!(1e-6 * width_px * height_px > here.config_.max_megapixels)) return GST_PAD_PROBE_OK;
  if (here.is_too_large_.exchange(true)) return GST_PAD_PROBE_DROP;  // GStreamer tries again
  here.exchange_.count_refused();
  const GstObjectPtr<GstElement> parser{gst_pad_get_parent_element(pad)};
  GST_ELEMENT_ERROR(parser.get(), STREAM, FORMAT,
                    ("pictures of %d x %d pixels are larger than video.max_megapixels", width_px, height_px),
                    (nullptr));
  return GST_PAD_PROBE_DROP;
}

GstFlowReturn RtspSession::on_sample(GstAppSink* sink, gpointer self) {
  const GstSamplePtr sample{gst_app_sink_pull_sample(sink)};
  if (!sample) return GST_FLOW_EOS;
  try {
    session(self)->deliver(sample.get());
  } catch (const std::exception&) {  // out of memory for the picture; an exception must not pass through C
    session(self)->exchange_.count_refused();
  }
  return GST_FLOW_OK;
}

void RtspSession::deliver(GstSample* sample) {
  const HostTime now = clock_.now();
  auto bgr = copy_bgr(sample, config_.max_megapixels);
  if (!bgr) return exchange_.count_refused();
  GstBuffer* buffer = gst_sample_get_buffer(sample);
  VideoFrame frame = timing_.stamp(rtp_timestamp(buffer), now);
  if (GST_BUFFER_FLAG_IS_SET(buffer, GST_BUFFER_FLAG_CORRUPTED)) frame.damaged = true;
  frame.bgr = std::move(*bgr);
  if (const auto record = telemetry_of(buffer))
    frame.telemetry = {camera_clock_.to_host(record->made_at, frame.received_at), *record};
  alive_at_ = now;
  relay_.note_frame();
  has_delivered_ = true;
  tap_.note(frame, running_time(gst_sample_get_segment(sample), GST_BUFFER_PTS(buffer)));
  exchange_.offer(std::move(frame));
}

}  // namespace geoloc::io
