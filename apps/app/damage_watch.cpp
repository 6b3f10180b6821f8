// SPDX-License-Identifier: Apache-2.0
#include "app/damage_watch.hpp"

#include <fmt/format.h>

namespace geoloc::apps {
namespace {

constexpr Duration kTextLasts = std::chrono::seconds{30};

double share(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

}  // namespace

const std::string& DamageWatch::observe(HostTime now, const io::VideoStatus& video) {
  samples_.push_back({now, video.frames, video.damaged, video.packets, video.lost_packets});
  while (now - samples_.front().at > kWindow) samples_.pop_front();
  const Sample &since = samples_.front(), &newest = samples_.back();
  const bool is_loss = newest.lost > since.lost;
  const bool is_damage =
      share(newest.damaged - since.damaged, newest.frames - since.frames) > kTolerableShare;
  if (!is_loss) {
    text_.clear();
  } else if (is_damage && (text_.empty() || now - written_at_ > kTextLasts)) {
    text_ = text(since, newest);
    written_at_ = now;
  }
  return text_;
}

std::string DamageWatch::text(const Sample& since, const Sample& now) const {
  const std::uint64_t lost = now.lost - since.lost;
  const char* remedy = transport_ == io::RtspTransport::kUdp
                           ? "set \"video\": {\"transport\": \"tcp\"} in --config, which loses none"
                           : "the camera itself leaves them out, so lower its bit rate";
  return fmt::format(
      "video: frames come, but {:.0f} % of them are damaged and left out, for {:.1f} % of the packets are "
      "lost: {}",
      100.0 * share(now.damaged - since.damaged, now.frames - since.frames),
      100.0 * share(lost, lost + now.packets - since.packets), remedy);
}

}  // namespace geoloc::apps
