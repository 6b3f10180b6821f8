// SPDX-License-Identifier: Apache-2.0
#include "app/console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace geoloc::apps {
namespace {

constexpr auto kReminderPeriod = std::chrono::seconds{30};

std::string status_line(const io::LiveStatus& status) {
  const int elapsed_s = static_cast<int>(seconds(status.elapsed));
  return fmt::format(
      "{:02d}:{:02d}  telemetry {:.0f}+{:.0f} Hz  video {} {:.0f}/s time {}  detect {:.0f} ms  latency "
      "{:.0f} ms  frames {}, {} without state  objects {} (+{})",
      elapsed_s / 60, elapsed_s % 60, status.attitude_rate_hz, status.position_rate_hz, status.video_state,
      status.video_rate_hz, status.frame_time, status.detect_ms, status.latency_ms, status.frames,
      status.frames_unusable, status.objects, status.tentative);
}

}  // namespace

Console::Console() : is_terminal_(::isatty(STDERR_FILENO) == 1) {}

void Console::say(const std::string& message) {
  std::fprintf(stderr, "%s%s\n", line_is_open_ ? "\r\033[K" : "", message.c_str());
  line_is_open_ = false;
}

void Console::tell(Topic& topic, HostTime now, const std::string& message, bool is_bad) {
  const bool is_reminder = is_bad && now - topic.told_at > kReminderPeriod;
  if (message == topic.last && !is_reminder) return;
  topic = {message, now};
  if (!message.empty()) say(message);
}

void Console::update(const io::LiveStatus& status) {
  tell(link_, status.at, status.link, !status.link_is_good);
  tell(video_, status.at, status.video, !status.video_is_good);
  tell(warning_, status.at, status.warning, true);
  std::fprintf(stderr, is_terminal_ ? "\r\033[K%s" : "%s\n", status_line(status).c_str());
  std::fflush(stderr);
  line_is_open_ = is_terminal_;
}

}  // namespace geoloc::apps
