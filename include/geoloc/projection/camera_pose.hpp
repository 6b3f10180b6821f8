// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/camera/camera.hpp"
#include "geoloc/state/vehicle_state.hpp"

namespace geoloc {

enum class CameraOrientation {
  kComposed,    ///< the mount turns in the body frame: enu_from_body * body_from_camera
  kAddedAngles  ///< the mount's angles are added to the vehicle's (paper, eq. 6): right only at small roll
                ///< and pitch
};

/// Pose of the camera at the state's instant.
Rigid3d enu_from_camera(const VehicleState& state, const CameraMount& mount, CameraOrientation orientation);

}  // namespace geoloc
