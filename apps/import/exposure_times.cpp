// SPDX-License-Identifier: Apache-2.0
#include "import/exposure_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

namespace geoloc::apps {
namespace {

using namespace std::chrono_literals;

const io::CaptureTime& taken(const TimedStill& still) {
  return *still.named.still.taken;
}

/// The time zone of pictures that tell none: the user's, or that of another picture, or none at all.
Duration assumed_zone(const std::vector<NamedStill>& stills, std::optional<double> utc_offset_h,
                      std::vector<std::string>& assumptions) {
  const auto silent = std::count_if(stills.begin(), stills.end(),
                                    [](const NamedStill& named) { return !named.still.taken->utc_offset; });
  if (silent == 0) return {};
  if (utc_offset_h) return from_seconds(3600.0 * *utc_offset_h);
  const auto told = std::find_if(stills.begin(), stills.end(), [](const NamedStill& named) {
    return named.still.taken->utc_offset.has_value();
  });
  const Duration zone = told != stills.end() ? *told->still.taken->utc_offset : Duration{};
  const std::string source =
      told != stills.end() ? fmt::format("that of {}", told->file.filename().string()) : "UTC";
  assumptions.push_back(
      fmt::format("{} pictures do not tell their time zone: {} is assumed (--utc-offset-h says another)",
                  silent, source));
  return zone;
}

/// Pictures of one second that tell no fraction are spread over it, in the order of their names.
void spread_within_seconds(std::vector<TimedStill>& stills, std::vector<std::string>& assumptions) {
  std::size_t spread = 0;
  for (auto begin = stills.begin(); begin != stills.end();) {
    const auto end = std::find_if(begin, stills.end(), [&](const TimedStill& still) {
      return still.at != begin->at || taken(still).has_fraction;
    });
    const auto count = std::max<std::ptrdiff_t>(end - begin, 1);
    for (std::ptrdiff_t i = 0; i < count; ++i) (begin + i)->at += i * Duration{1s} / count;
    spread += count > 1 ? static_cast<std::size_t>(count) : 0;
    begin += count;
  }
  if (spread > 0)
    assumptions.push_back(fmt::format(
        "{} pictures tell the same second as another one, and no fraction of it: they are taken to be spread "
        "evenly over it, in the order of their names",
        spread));
}

/// Telemetry has milliseconds, and one state for each.
void separate(std::vector<TimedStill>& stills) {
  for (std::size_t i = 0; i < stills.size(); ++i) {
    stills[i].at = HostTime{std::chrono::round<std::chrono::milliseconds>(stills[i].at.time_since_epoch())};
    if (i > 0) stills[i].at = std::max(stills[i].at, stills[i - 1].at + 1ms);
  }
}

}  // namespace

std::vector<TimedStill> in_order_of_time(std::vector<NamedStill> stills, std::optional<double> utc_offset_h,
                                         std::vector<std::string>& assumptions) {
  const Duration zone = assumed_zone(stills, utc_offset_h, assumptions);
  std::vector<TimedStill> timed;
  timed.reserve(stills.size());
  for (NamedStill& named : stills) {
    const io::CaptureTime& time = *named.still.taken;
    const HostTime at{time.local - time.utc_offset.value_or(zone)};
    timed.push_back({std::move(named), at});
  }
  std::sort(timed.begin(), timed.end(), [](const TimedStill& a, const TimedStill& b) {
    return std::tie(a.at, a.named.file) < std::tie(b.at, b.named.file);
  });
  spread_within_seconds(timed, assumptions);
  separate(timed);
  return timed;
}

}  // namespace geoloc::apps
