// SPDX-License-Identifier: Apache-2.0
#include "common/clock_message.hpp"

#include <fmt/format.h>

namespace geoloc::apps {

std::string clock_message(const io::VehicleClockMap& clock) {
  const auto steps = clock.counts().steps;
  if (steps == 0) return {};
  const std::string change = fmt::format("the vehicle's clock jumped by {:+.2f} s against this computer's",
                                         seconds(clock.last_step()));
  const std::string times = steps == 1 ? "" : fmt::format(", the last of {} times", steps);
  return change + times + ": frames of that moment are left out";
}

}  // namespace geoloc::apps
