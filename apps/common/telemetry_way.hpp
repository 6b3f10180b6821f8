// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace geoloc::apps {

/// What a vehicle's telemetry comes by.
enum class TelemetryWay {
  kUndecided,  ///< no frame has come yet that would tell
  kMavlink,
  kVideo  ///< in the video's own frames
};

}  // namespace geoloc::apps
