// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/telemetry_way.hpp"
#include "geoloc/io/mavlink/link_guard.hpp"
#include "geoloc/io/mavlink/link_status.hpp"
#include "geoloc/pipeline/geolocator.hpp"

namespace geoloc::apps {

/// How the vehicle's telemetry is, for people.
struct LinkMessage {
  std::string text;
  bool is_good = false;  ///< frames can be located
  std::string fault;     ///< why they cannot, in short; empty where they can
};

/// `geolocator`: what became of the telemetry, and whether its camera is on a gimbal.
LinkMessage link_message(const io::LinkStatus& link, const Geolocator& geolocator,
                         TelemetryWay way = TelemetryWay::kMavlink);

/// Why frames of a camera on a gimbal are not located that tells nothing, and what would change it.
inline constexpr const char* kNoGimbalAngles =
    "no angles of the gimbal come (GIMBAL_DEVICE_ATTITUDE_STATUS, MOUNT_ORIENTATION or MOUNT_STATUS): let "
    "the "
    "autopilot or the gimbal send them, or set camera.mount.kind to fixed";

/// What was refused at the link's door within the last seconds; empty where nothing was.
std::string refusal_message(const io::LinkGuard& guard, HostTime now);

/// All that was refused in a run; empty where nothing was.
std::string count_of_refusals(const io::LinkGuard::Counts& counts);

}  // namespace geoloc::apps
