// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/camera/camera.hpp"
#include "import/flight_track.hpp"

namespace geoloc::apps {

/// The camera on the gimbal as it was mounted in the vehicle at a time of the log. The lever arm is that of
/// `mount`. nullopt where the gimbal's or the vehicle's angles are not known within a second.
std::optional<CameraMount> gimbal_mount(const FlightTrack& track, const CameraMount& mount, VehicleTime time);

}  // namespace geoloc::apps
