// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/io/output/live_status.hpp"

namespace geoloc::apps {

/// How a live run is doing, in one line that usually fits 80 columns. What matters most comes first, since a
/// narrow terminal shows the beginning.
std::string status_line(const io::LiveStatus& status);

}  // namespace geoloc::apps
