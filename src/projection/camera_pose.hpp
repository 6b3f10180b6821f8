// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/camera/camera.hpp"
#include "geoloc/projection/ground_fix.hpp"
#include "geoloc/state/vehicle_state.hpp"

namespace geoloc {

/// Pose of a camera that is fixed to the body, at the state's instant.
Rigid3d enu_from_camera(const VehicleState& state, const CameraMount& mount, CameraOrientation orientation);

/// Pose of a camera on a gimbal: turned as the gimbal is, in the place of its lever arm in the body.
Rigid3d enu_from_camera(const VehicleState& state, const GimbalState& gimbal, const CameraMount& mount);

/// The turn of a camera that is fixed to the body.
CameraTurn turn_of(const VehicleState& state);

/// The turn of a camera on a gimbal.
CameraTurn turn_of(const VehicleState& state, const GimbalState& gimbal);

}  // namespace geoloc
