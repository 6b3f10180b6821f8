// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/picture_reader.hpp"

namespace geoloc::apps {

/// A picture with its time; no two have the same.
struct TimedStill {
  NamedStill named;
  HostTime at;
};

/// In the order of their times, to whole milliseconds, which is what telemetry has. Pictures must have a
/// time. `utc_offset_h`: what cameras' clocks are ahead of UTC where pictures do not tell. What was assumed
/// is added to `assumptions`.
std::vector<TimedStill> in_order_of_time(std::vector<NamedStill> stills, std::optional<double> utc_offset_h,
                                         std::vector<std::string>& assumptions);

}  // namespace geoloc::apps
