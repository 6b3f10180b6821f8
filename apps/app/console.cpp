// SPDX-License-Identifier: Apache-2.0
#include "app/console.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "geoloc/io/output/text.hpp"

namespace geoloc::apps {
namespace {

constexpr auto kReminderPeriod = std::chrono::seconds{30};
constexpr const char* kClearLine = "\r\033[K";

/// What matters most comes first: a narrow terminal shows the beginning.
std::string status_line(const io::LiveStatus& status) {
  const int elapsed_s = static_cast<int>(seconds(status.elapsed));
  const std::string damaged =
      status.frames_damaged > 0 ? fmt::format(", {} damaged", status.frames_damaged) : "";
  return fmt::format(
      "{:02d}:{:02d}  objects {} (+{})  telemetry {:.0f}+{:.0f} Hz  video {} {:.0f}/s  latency {:.0f} ms  "
      "frames {}, {} without state{}  detect {:.0f} ms  time {}",
      elapsed_s / 60, elapsed_s % 60, status.objects, status.tentative, status.attitude_rate_hz,
      status.position_rate_hz, status.video_state, status.video_rate_hz, status.latency_ms, status.frames,
      status.frames_unusable, damaged, status.detect_ms, status.frame_time);
}

/// Characters in a line of the terminal. One that is longer would be wrapped, and could not be overwritten.
std::size_t terminal_width() {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  const bool is_known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return is_known ? size.ws_col : kUsual;
}

}  // namespace

Console::Console() : stderr_(STDERR_FILENO), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

void Console::say(const std::string& message) {
  stderr_.post((line_is_open_ ? kClearLine : "") + message + "\n");
  line_is_open_ = false;
}

void Console::tell(Topic& topic, HostTime now, const std::string& message, bool is_bad) {
  const bool is_reminder = is_bad && now - topic.told_at > kReminderPeriod;
  if (message == topic.last && !is_reminder) return;
  topic = {message, now};
  if (!message.empty()) say(io::clean_text(message));  // a server's words may be in it
}

void Console::update(const io::LiveStatus& status) {
  tell(link_, status.at, status.link, !status.link_is_good);
  tell(video_, status.at, status.video, !status.video_is_good);
  tell(clock_, status.at, status.clock, false);
  tell(warning_, status.at, status.warning, true);
  const std::string line = status_line(status);
  stderr_.post(is_terminal_ ? kClearLine + line.substr(0, terminal_width() - 1) : line + "\n");
  line_is_open_ = is_terminal_;
}

}  // namespace geoloc::apps
