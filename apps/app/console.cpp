// SPDX-License-Identifier: Apache-2.0
#include "app/console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace geoloc::apps {
namespace {

constexpr auto kLinePeriod = std::chrono::seconds{1};
constexpr auto kReminderPeriod = std::chrono::seconds{30};
constexpr double kSilence_s = 3.0;

bool is_silent(const std::optional<Duration>& since) {
  return !since || seconds(*since) > kSilence_s;
}

std::string link_message(const io::LinkStatus& link) {
  if (!link.vehicle) return "waiting for a vehicle: no MAVLink heartbeat of an autopilot yet";
  const std::string name = fmt::format("vehicle {}", link.vehicle->system);
  if (is_silent(link.since_attitude)) return name + ": no attitude comes; frames cannot be located";
  if (is_silent(link.since_position))
    return name + ": no position comes (no fix yet?); frames cannot be located";
  return name + ": telemetry comes";
}

std::string video_message(const io::VideoStatus& video) {
  switch (video.state) {
    case io::VideoState::kConnecting:
      return "video: connecting";
    case io::VideoState::kPlaying:
      return "video: frames come";
    case io::VideoState::kRetrying:
      return "video: trying again: " + video.last_error;
    case io::VideoState::kEnded:
      return video.last_error.empty() ? "video: ended" : "video: ended: " + video.last_error;
  }
  return {};
}

std::string tracks(const Geolocator& geolocator) {
  const auto& all = geolocator.tracks();
  const auto confirmed = std::count_if(
      all.begin(), all.end(), [](const Track& track) { return track.status == TrackStatus::kConfirmed; });
  return fmt::format("objects {} (+{})", confirmed, static_cast<std::ptrdiff_t>(all.size()) - confirmed);
}

std::string status_line(double elapsed_s, const io::LinkStatus& link, const io::VideoStatus& video,
                        const DetectionWorker::Stats& detection, const LiveRun::Stats& run,
                        const Session& session) {
  return fmt::format(
      "{:02d}:{:02d}  telemetry {:.0f}+{:.0f} Hz  video {} {:.0f}/s time {}  detect {:.0f} ms  latency "
      "{:.0f} ms  frames "
      "{}, {} without state  {}",
      static_cast<int>(elapsed_s) / 60, static_cast<int>(elapsed_s) % 60, link.attitude_rate_hz,
      link.position_rate_hz, to_string(video.state), video.frames_per_second, to_string(run.time_quality),
      detection.detect_ms.value(), 1e3 * run.latency_s.value(), session.frames(), session.frames_unusable(),
      tracks(session.geolocator()));
}

}  // namespace

Console::Console(HostTime started_at) : started_at_(started_at), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

void Console::say(const std::string& message) {
  std::fprintf(stderr, "%s%s\n", line_is_open_ ? "\r\033[K" : "", message.c_str());
  line_is_open_ = false;
}

void Console::tell(Topic& topic, HostTime now, const std::string& message, bool is_bad) {
  const bool is_reminder = is_bad && now - topic.told_at > kReminderPeriod;
  if (message == topic.last && !is_reminder) return;
  topic = {message, now};
  say(message);
}

void Console::update(HostTime now, const Session& session, const io::VideoSource& video,
                     const DetectionWorker& worker, const LiveRun& run) {
  if (now - line_at_ < kLinePeriod) return;
  line_at_ = now;
  const io::LinkStatus link = session.link().status(now);
  const io::VideoStatus stream = video.status();
  const DetectionWorker::Stats detection = worker.stats();
  tell(link_, now, link_message(link), is_silent(link.since_attitude) || is_silent(link.since_position));
  tell(video_, now, video_message(stream), stream.state == io::VideoState::kRetrying);
  if (detection.wrong_size > 0) tell(size_, now, detection.wrong_size_message, true);

  const std::string line =
      status_line(seconds(now - started_at_), link, stream, detection, run.stats(), session);
  std::fprintf(stderr, is_terminal_ ? "\r\033[K%s" : "%s\n", line.c_str());
  std::fflush(stderr);
  line_is_open_ = is_terminal_;
}

}  // namespace geoloc::apps
