// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/io/recording/tlog.hpp"
#include "import/video_offset.hpp"

namespace geoloc::apps {

/// When a MAVLink log begins, and when its cameras took pictures and began videos, as the messages tell.
/// Times are the log's stamps. The log must not be empty.
LogTimes times_of(const io::Tlog& telemetry);

/// Whether it has the angles of a gimbal.
bool tells_gimbal(const io::Tlog& telemetry);

}  // namespace geoloc::apps
