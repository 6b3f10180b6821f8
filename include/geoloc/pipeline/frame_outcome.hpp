// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "geoloc/geometry/time.hpp"

namespace geoloc {

/// What became of a frame.
enum class FrameFate {
  kLocated,          ///< its detections are in located(), and the objects were refined with them
  kNoTelemetry,      ///< no attitude, or no position, has come that could be used
  kBeforeTelemetry,  ///< older than the oldest sample kept
  kInAGap,  ///< between two samples that lie too far apart, or where the vehicle's state stepped, or the zoom
            ///< changed unseen
  kAfterTelemetry,      ///< newer than the newest sample, and waited for no longer
  kOutOfOrder,          ///< no later than a frame that was located before
  kClockBegunAnew,      ///< the vehicle's clock began anew, or stepped, while the frame waited
  kNoRoom,              ///< too many waited, and nobody called process_next()
  kUnusableMount,       ///< its mount cannot be
  kNoGimbal,            ///< its camera is on a gimbal, and no angles of that have come
  kUnusableFocalLength  ///< its focal length cannot be
};
inline constexpr std::size_t kFrameFates = 11;

/// A sentence for a log: what became of the frame and, where it was not located, what would change that.
const char* explain(FrameFate fate);

/// A frame that waits no longer.
struct FrameOutcome {
  VehicleTime captured_at;
  HostTime captured_at_host;
  FrameFate fate;

  bool is_located() const { return fate == FrameFate::kLocated; }
};

/// Until when frames wait.
enum class FrameWait {
  kForTelemetry,  ///< until there are samples from beyond their time
  kNoLonger       ///< telemetry has ended, or the caller's patience: what is known now decides
};

}  // namespace geoloc
