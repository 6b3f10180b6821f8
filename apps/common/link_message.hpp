// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/mavlink/link_guard.hpp"
#include "geoloc/io/mavlink/link_status.hpp"
#include "geoloc/state/state_provider.hpp"

namespace geoloc::apps {

/// How the vehicle's telemetry is, for people.
struct LinkMessage {
  std::string text;
  bool is_good = false;  ///< frames can be located
  std::string fault;     ///< why they cannot, in short; empty where they can
};

/// `state`: what became of the telemetry in the estimator.
LinkMessage link_message(const io::LinkStatus& link, const StateProvider& state);

/// What was refused at the link's door within the last seconds; empty where nothing was.
std::string refusal_message(const io::LinkGuard& guard, HostTime now);

/// All that was refused in a run; empty where nothing was.
std::string count_of_refusals(const io::LinkGuard::Counts& counts);

}  // namespace geoloc::apps
