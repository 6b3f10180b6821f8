// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/exposure_times.hpp"

namespace geoloc::apps {

/// What is known of the take-off's height beside the pictures, in their datum.
struct TakeOffHeights {
  std::optional<double> told_m;   ///< by the user
  std::optional<double> marks_m;  ///< mean of the survey's marks
};

/// Heights of all pictures.
struct FlightHeights {
  std::vector<double> above_take_off_m;       ///< one a picture
  std::optional<double> take_off_absolute_m;  ///< in the pictures' datum
  std::optional<double> take_off_msl_m;       ///< above sea level, where that is known
};

/// Heights above the take-off are the pictures' own, or their absolute ones less the take-off's; with RTK,
/// whose absolute heights are the better ones, they are these less the mean difference. What was assumed is
/// added to `assumptions`. Throws std::runtime_error where a picture tells neither.
FlightHeights heights_of(const std::vector<TimedStill>& stills, const TakeOffHeights& take_off,
                         std::vector<std::string>& assumptions);

}  // namespace geoloc::apps
