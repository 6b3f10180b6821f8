// SPDX-License-Identifier: Apache-2.0
#include "app/console.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include "app/status_line.hpp"
#include "geoloc/io/output/text.hpp"

namespace geoloc::apps {
namespace {

constexpr auto kReminderPeriod = std::chrono::seconds{30};
/// Connections are made and streams are asked for so long after the start: what is missing then is no fault.
constexpr auto kSettling = std::chrono::seconds{5};
/// Between status lines where they do not replace each other.
constexpr auto kLogPeriod = std::chrono::seconds{2};
constexpr const char* kClearLine = "\r\033[K";

/// Characters in a line of the terminal. One that is longer would be wrapped, and could not be overwritten.
std::size_t terminal_width() {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  const bool is_known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return is_known ? size.ws_col : kUsual;
}

}  // namespace

Console::Console()
    : stderr_(STDERR_FILENO), is_terminal_(::isatty(STDERR_FILENO) == 1), log_line_(kLogPeriod, {}) {}

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
  const bool has_settled = status.elapsed >= kSettling;
  if (has_settled || status.link_is_good) tell(link_, status.at, status.link, !status.link_is_good);
  if (has_settled || status.video_is_good) tell(video_, status.at, status.video, !status.video_is_good);
  tell(clock_, status.at, status.clock, false);
  tell(warning_, status.at, status.warning, true);
  if (is_terminal_) {
    stderr_.post(kClearLine + status_line(status).substr(0, terminal_width() - 1));
    line_is_open_ = true;
  } else if (log_line_.is_due(status.at)) {
    stderr_.post(status_line(status) + "\n");
  }
}

}  // namespace geoloc::apps
