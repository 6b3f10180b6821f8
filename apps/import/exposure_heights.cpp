// SPDX-License-Identifier: Apache-2.0
#include "import/exposure_heights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "import/name_list.hpp"
#include "import/sea_level.hpp"

namespace geoloc::apps {
namespace {

constexpr int kRtkFixed = 50;

const io::Still& still_of(const TimedStill& timed) {
  return timed.named.still;
}

/// The absolute height of the take-off, by the pictures that tell both heights.
std::optional<double> absolute_by_pictures_m(const std::vector<TimedStill>& stills) {
  std::vector<double> differences_m;
  for (const TimedStill& timed : stills) {
    const io::Still& still = still_of(timed);
    if (still.height_absolute_m && still.height_above_take_off_m)
      differences_m.push_back(*still.height_absolute_m - *still.height_above_take_off_m);
  }
  if (differences_m.empty()) return std::nullopt;
  const auto middle = differences_m.begin() + static_cast<std::ptrdiff_t>(differences_m.size() / 2);
  std::nth_element(differences_m.begin(), middle, differences_m.end());
  return *middle;
}

bool lacks_relative_height(const TimedStill& timed) {
  return !still_of(timed).height_above_take_off_m;
}

bool counts_from_ellipsoid(const std::vector<TimedStill>& stills) {
  return std::any_of(stills.begin(), stills.end(), [](const TimedStill& timed) {
    return still_of(timed).datum == io::HeightDatum::kEllipsoid;
  });
}

std::optional<double> take_off_absolute_m(const std::vector<TimedStill>& stills,
                                          const TakeOffHeights& take_off,
                                          std::vector<std::string>& assumptions) {
  if (const auto height_m = absolute_by_pictures_m(stills)) {
    if (take_off.told_m)
      assumptions.push_back(
          "--take-off-height-m is not used: the pictures tell their heights above the take-off");
    return height_m;
  }
  if (take_off.told_m) return take_off.told_m;
  const bool is_needed = std::any_of(stills.begin(), stills.end(), &lacks_relative_height);
  if (!take_off.marks_m || !is_needed) return std::nullopt;
  assumptions.push_back(fmt::format(
      "the pictures do not tell their heights above the take-off: it is taken to be as high as the survey's "
      "marks, {:.1f} m, in the datum of the pictures (--take-off-height-m says another)",
      *take_off.marks_m));
  return take_off.marks_m;
}

/// Names the pictures whose heights nothing tells.
void refuse_without_height(const std::vector<TimedStill>& stills, bool is_take_off_known) {
  std::vector<std::string> names;
  for (const TimedStill& timed : stills) {
    if (lacks_relative_height(timed) && !(is_take_off_known && still_of(timed).height_absolute_m))
      names.push_back(timed.named.file.filename().string());
  }
  if (names.empty()) return;
  const bool has_absolute = still_of(stills.front()).height_absolute_m.has_value();
  throw std::runtime_error(fmt::format(
      "{} tell no height above the take-off{}", name_list(names),
      has_absolute ? fmt::format(": give the take-off's height, in the datum of the pictures ({}), with "
                                 "--take-off-height-m",
                                 counts_from_ellipsoid(stills) ? "above the ellipsoid" : "above sea level")
                   : ", nor above the sea: nothing can be located from them"));
}

double height_m(const io::Still& still, const std::optional<double>& take_off_m) {
  const bool has_both = take_off_m && still.height_absolute_m;
  const bool is_precise = has_both && still.rtk_flag.value_or(0) == kRtkFixed;
  if (still.height_above_take_off_m && !is_precise) return *still.height_above_take_off_m;
  return *still.height_absolute_m - *take_off_m;
}

}  // namespace

FlightHeights heights_of(const std::vector<TimedStill>& stills, const TakeOffHeights& take_off,
                         std::vector<std::string>& assumptions) {
  FlightHeights heights;
  heights.take_off_absolute_m = take_off_absolute_m(stills, take_off, assumptions);
  refuse_without_height(stills, heights.take_off_absolute_m.has_value());
  for (const TimedStill& timed : stills)
    heights.above_take_off_m.push_back(height_m(still_of(timed), heights.take_off_absolute_m));
  if (heights.take_off_absolute_m) {
    heights.take_off_msl_m =
        counts_from_ellipsoid(stills)
            ? height_msl_m(still_of(stills.front()).position, *heights.take_off_absolute_m,
                           "the pictures' absolute heights count from the ellipsoid (RTK)", assumptions)
            : *heights.take_off_absolute_m;
  } else {
    assumptions.push_back("the pictures tell no absolute heights: the take-off is taken to be at sea level");
  }
  return heights;
}

}  // namespace geoloc::apps
