// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/live_options.hpp"

namespace geoloc::apps {

/// How long the detector of a run takes for a picture of its camera, as a line for people: the median of
/// several. Throws std::runtime_error as the run would.
std::string time_detector(const LiveOptions& options);

}  // namespace geoloc::apps
