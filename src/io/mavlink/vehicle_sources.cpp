// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/vehicle_sources.hpp"

#include <algorithm>

#include "mav_numbers.hpp"
#include "timing.hpp"

namespace geoloc::io {

bool VehicleSources::admits(MavAddress sender, bool is_state, const LinkSource& source, HostTime now) {
  if (sender.component != kAutopilotComponent) return true;
  std::optional<Speaker>& speaker = speakers_[sender.system];
  if (!speaker || (speaker->source != source && may_replace(*speaker, is_state, now)))
    speaker = Speaker{source, now, std::nullopt};
  if (speaker->source != source) {
    last_refusal_ = Refusal{sender.system, source, speaker->source, now};
    return false;
  }
  if (is_state) speaker->last_state = now;
  return true;
}

bool VehicleSources::may_replace(const Speaker& speaker, bool is_state, HostTime now) const {
  if (is_state) return !speaker.last_state || now - *speaker.last_state > silence_;
  return now - std::max(speaker.since, speaker.last_state.value_or(speaker.since)) > kAutopilotsTurn;
}

}  // namespace geoloc::io
