// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/session.hpp"

namespace geoloc::apps {

/// What the clocks of vehicle, camera and this computer did that they should not, for people; empty where
/// nothing.
std::string clock_message(const Session& session);

}  // namespace geoloc::apps
