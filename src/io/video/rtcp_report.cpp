// SPDX-License-Identifier: Apache-2.0
#include "rtcp_report.hpp"

#include <gst/rtp/rtp.h>

#include "io/gst/gst_handles.hpp"

namespace geoloc::io {
namespace {

std::optional<SenderTime> sent_at(GstBuffer* buffer) {
  GstRTCPBuffer rtcp = GST_RTCP_BUFFER_INIT;
  if (gst_rtcp_buffer_map(buffer, GST_MAP_READ, &rtcp) == FALSE) return std::nullopt;
  std::optional<SenderTime> found;
  GstRTCPPacket packet;
  for (gboolean more = gst_rtcp_buffer_get_first_packet(&rtcp, &packet); more != FALSE && !found;
       more = gst_rtcp_packet_move_to_next(&packet)) {
    if (gst_rtcp_packet_get_type(&packet) != GST_RTCP_TYPE_SR) continue;
    guint64 ntp_time = 0;
    gst_rtcp_packet_sr_get_sender_info(&packet, nullptr, &ntp_time, nullptr, nullptr, nullptr);
    if (ntp_time != 0) found = from_ntp(ntp_time);  // 0: the sender has no wall clock
  }
  gst_rtcp_buffer_unmap(&rtcp);
  return found;
}

}  // namespace

std::optional<SenderReport> sender_report(const GstStructure* sync) {
  GstBuffer* buffer = nullptr;
  guint64 extended_timestamp = 0;
  guint ticks_per_second = 0;
  const bool is_complete =
      gst_structure_get(sync, "clock-rate", G_TYPE_UINT, &ticks_per_second, "sr-ext-rtptime", G_TYPE_UINT64,
                        &extended_timestamp, "sr-buffer", GST_TYPE_BUFFER, &buffer, nullptr) != FALSE;
  const GstBufferPtr owned{buffer};
  if (!is_complete || !owned) return std::nullopt;
  const auto time = sent_at(owned.get());
  if (!time) return std::nullopt;
  return SenderReport{static_cast<std::uint32_t>(extended_timestamp), ticks_per_second, *time};
}

}  // namespace geoloc::io
