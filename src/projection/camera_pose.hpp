// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/camera/camera.hpp"
#include "geoloc/state/vehicle_state.hpp"

namespace geoloc {

/// Pose of the camera at the state's instant.
Rigid3d enu_from_camera(const VehicleState& state, const CameraMount& mount, CameraOrientation orientation);

}  // namespace geoloc
