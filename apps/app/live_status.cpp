// SPDX-License-Identifier: Apache-2.0
#include "app/live_status.hpp"

#include <algorithm>

#include "common/clock_message.hpp"
#include "common/link_message.hpp"

namespace geoloc::apps {
namespace {

/// Reports that tell capture times come within so long.
constexpr Duration kReportsCome = std::chrono::seconds{15};

/// Where a stream does not tell when frames were taken; empty where it does.
std::string of_stamps(const io::VideoStatus& video, TelemetryWay way, Duration elapsed) {
  const bool tells = way == TelemetryWay::kVideo || (video.time_quality != io::TimeQuality::kArrival &&
                                                     video.time_quality != io::TimeQuality::kForeignClock);
  if (tells || elapsed < kReportsCome) return {};
  return "; the stream does not tell when they were taken, so it is estimated from when they arrive (less "
         "video.latency_s)";
}

std::string video_message(const io::VideoStatus& video, TelemetryWay way, Duration elapsed) {
  switch (video.state) {
    case io::VideoState::kConnecting:
      return "video: connecting";
    case io::VideoState::kPlaying:
      return "video: frames come" + of_stamps(video, way, elapsed);
    case io::VideoState::kRetrying:
      return "video: trying again: " + video.last_error;
    case io::VideoState::kEnded:
      return video.last_error.empty() ? "video: ended" : "video: ended: " + video.last_error;
  }
  return {};
}

}  // namespace

io::LiveStatus live_status(HostTime now, HostTime started_at, const Session& session,
                           const TelemetryInput& telemetry, const io::VideoSource& video,
                           const DetectionWorker& worker, const LiveRun& run, const std::string& damage,
                           const std::string& doubt) {
  const io::LinkStatus link = session.link().status(now);
  const io::VideoStatus stream = video.status();
  const DetectionWorker::Stats detection = worker.stats();
  const auto& tracks = session.geolocator().tracks();
  io::LiveStatus status;
  status.at = now;
  status.elapsed = now - started_at;
  const LinkMessage message = link_message(link, session.geolocator(), telemetry.way());
  const std::string refusal = refusal_message(telemetry.guard(), now);
  status.link = message.text + (refusal.empty() ? "" : "; ") + refusal;
  status.link_is_good = message.is_good;
  status.attitude_rate_hz = link.attitude_rate_hz;
  status.position_rate_hz = link.position_rate_hz;
  const bool is_playing = stream.state == io::VideoState::kPlaying;
  status.video =
      is_playing && !damage.empty() ? damage : video_message(stream, telemetry.way(), status.elapsed);
  status.video_is_good = is_playing && damage.empty();
  status.video_state = to_string(stream.state);
  status.video_rate_hz = stream.frames_per_second;
  status.frame_time = to_string(run.stats().time_quality);
  status.clock = clock_message(session);
  status.warning = detection.wrong_size_message.empty() ? doubt : detection.wrong_size_message;
  status.detect_ms = detection.detect_ms.value();
  status.latency_ms = 1e3 * run.stats().latency_s.value();
  status.frames = session.frames();
  status.frames_unusable = session.frames_unusable();
  status.frames_damaged = detection.damaged;
  status.packets_lost = stream.lost_packets;
  status.objects =
      static_cast<std::uint64_t>(std::count_if(tracks.begin(), tracks.end(), [](const Track& track) {
        return track.status == TrackStatus::kConfirmed;
      }));
  status.tentative = tracks.size() - status.objects;
  status.frames_searched = detection.detected;
  status.frames_dropped = stream.dropped;
  return status;
}

}  // namespace geoloc::apps
