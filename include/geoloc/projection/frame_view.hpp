// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/rigid3.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/state/vehicle_state.hpp"

namespace geoloc {

/// One detection with its place on the ground.
struct LocatedDetection {
  Detection detection;
  GroundFix fix;
};

/// From where a frame was seen.
struct FrameView {
  VehicleState vehicle;     ///< at the instant that the frame is taken to show
  Rigid3d enu_from_camera;  ///< calibration applied
  HostTime captured_at_host;
};

}  // namespace geoloc
