// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/mavlink/clock_mapping.hpp"

namespace geoloc::apps {

/// What the vehicle's clock did against this computer's, for people; empty where nothing.
std::string clock_message(const io::VehicleClockMap& clock);

}  // namespace geoloc::apps
