// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/io/video/video_config.hpp"
#include "settings/rules.hpp"

namespace geoloc {

template <>
struct EnumNames<io::RtspTransport> {
  static constexpr std::array<std::pair<io::RtspTransport, const char*>, 2> all{
      {{io::RtspTransport::kTcp, "tcp"}, {io::RtspTransport::kUdp, "udp"}}};
};

namespace io {

template <class Visitor>
void visit_fields(Visitor& v, VideoConfig& video) {
  v.field("transport", video.transport, Any{}, "",
          "Transport of the RTSP stream: a bad link shows as delay with tcp, as damaged pictures with udp");
  v.field("latency_s", video.latency_s, Range::closed(0, 10), "s",
          "Exposure to arrival, taken off where the stream does not tell the capture time");
  v.field("reorder_s", video.reorder_s, Range::closed(0, 2), "s",
          "How long UDP packets out of order are waited for");
  v.field("frame_timeout_s", video.frame_timeout_s, Range::closed(0.2, 60), "s",
          "Without a frame for this long, the stream is connected anew");
  v.field("connect_timeout_s", video.connect_timeout_s, Range::closed(0.5, 60), "s",
          "Without a first frame for this long, the stream is connected anew");
  v.field("retry_min_s", video.retry_min_s, Range::closed(0.05, 60), "s",
          "Pause before another attempt to connect; it doubles while they fail");
  v.field("retry_max_s", video.retry_max_s, Range::closed(0.05, 60), "s",
          "Longest pause; at least retry_min_s");
  v.relation("retry_max_s", video.retry_max_s, video.retry_max_s >= video.retry_min_s,
             "must be at least retry_min_s");
  v.field("max_megapixels", video.max_megapixels, Range::above(0, 1000), "Mpx",
          "Larger pictures are rejected; H.264 ends at 35.7");
}

}  // namespace io
}  // namespace geoloc
