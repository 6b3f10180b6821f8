// SPDX-License-Identifier: Apache-2.0
#include "geoloc/pipeline/frame_outcome.hpp"

namespace geoloc {

const char* explain(FrameFate fate) {
  switch (fate) {
    case FrameFate::kLocated:
      return "The frame was located.";
    case FrameFate::kNoTelemetry:
      return "No attitude, or no position, has come that could be used: state().counters() tells what came.";
    case FrameFate::kBeforeTelemetry:
      return "The frame was captured before the oldest sample that is kept: either telemetry began later, or "
             "frames are not stamped on the vehicle's clock.";
    case FrameFate::kInAGap:
      return "The frame was captured in a gap of the telemetry longer than state.max_gap_s, or where the "
             "vehicle's state stepped, or the camera's zoom changed unseen.";
    case FrameFate::kAfterTelemetry:
      return "The frame was captured after the newest sample, and waited for no longer: either telemetry has "
             "ended, or frames are not stamped on the vehicle's clock.";
    case FrameFate::kOutOfOrder:
      return "The frame was captured no later than one that was located before: frames must be added before "
             "later ones have been located.";
    case FrameFate::kClockBegunAnew:
      return "The vehicle's clock began anew, or stepped, while the frame waited.";
    case FrameFate::kNoRoom:
      return "Too many frames wait: process_next() must be called until it returns nothing, after each "
             "frame that is added.";
    case FrameFate::kUnusableMount:
      return "The mount that came with the frame has an angle beyond 360 deg, a lever arm beyond 100 m, or "
             "is "
             "no number.";
    case FrameFate::kNoGimbal:
      return "The camera's mount is of kind gimbal, and no angles of the gimbal have come: add(GimbalSample) "
             "them, or set camera.mount.kind to fixed.";
    case FrameFate::kUnusableFocalLength:
      return "The focal length that came with the frame is not 0.01 to 10000 times the image's size that "
             "way: it is to be in pixels of the full image.";
  }
  return "";
}

}  // namespace geoloc
