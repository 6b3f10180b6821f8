// SPDX-License-Identifier: Apache-2.0
#include "app/status_line.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace geoloc::apps {
namespace {

/// Never rounded to all, nor to nothing.
std::string percent(std::uint64_t part, std::uint64_t whole) {
  const double share = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  if (part == 0 || part == whole) return fmt::format("{:.0f} %", share);
  return fmt::format("{:.0f} %", std::clamp(share, 1.0, 99.0));
}

std::string of_video(const io::LiveStatus& status) {
  std::string text = status.video_state == "playing" ? fmt::format("video {:.0f}/s", status.video_rate_hz)
                                                     : "video " + status.video_state;
  const std::uint64_t whole = status.frames_searched + status.frames_dropped;
  if (status.frames_damaged > 0) text += fmt::format(", {} damaged", status.frames_damaged);
  if (status.frames_dropped > 0) text += ", searched " + percent(status.frames_searched, whole);
  if (status.frames > 0)
    text += ", located " + percent(status.frames - status.frames_unusable, status.frames);
  return text;
}

}  // namespace

std::string status_line(const io::LiveStatus& status) {
  const int elapsed_s = static_cast<int>(seconds(status.elapsed));
  const bool has_room = status.frames_dropped + status.frames_damaged == 0;
  const bool is_known = status.frames > status.frames_unusable;
  const std::string delay =
      has_room && is_known ? fmt::format("  delay {:.1f} s", 1e-3 * status.latency_ms) : "";
  const std::string fleet = status.fleet.empty() ? "" : "  " + status.fleet;
  return fmt::format("{:02d}:{:02d}  objects {}  telemetry {:.0f}/s  {}{}{}", elapsed_s / 60, elapsed_s % 60,
                     status.objects, std::min(status.attitude_rate_hz, status.position_rate_hz),
                     of_video(status), delay, fleet);
}

}  // namespace geoloc::apps
