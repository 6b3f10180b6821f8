// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/camera/camera.hpp"
#include "import/flight_track.hpp"

namespace geoloc::apps {

/// The camera as the assumed gimbal held it in the vehicle at a time of the log. The lever arm is that of
/// `mount`. nullopt where the vehicle's angles are not known within a second.
std::optional<CameraMount> assumed_mount(const FlightTrack& track, const CameraMount& mount,
                                         VehicleTime time);

/// The mount of a camera whose gimbal's angles are told, in the place of `mount`; the angles of `mount` count
/// where it is one on a gimbal.
CameraMount told_mount(const CameraMount& mount);

}  // namespace geoloc::apps
