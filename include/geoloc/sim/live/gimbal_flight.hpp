// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geoloc/sim/flight/flight.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc::sim {

/// Where the operator points a gimbal.
enum class GimbalAim {
  kNadir,
  kOblique,  ///< 45 deg down
  kSweep     ///< up and down between 90 and 40 deg down, in twelve seconds
};

/// The message in which it tells its angles.
enum class GimbalTelling { kDeviceStatus, kMountOrientation, kMountStatus };

struct GimbalSettings {
  GimbalAim aim = GimbalAim::kNadir;
  bool holds_direction = false;  ///< to the north-north-east, within its limits; else it follows the nose
  GimbalYaw told_yaw = GimbalYaw::kFromNose;  ///< MOUNT_STATUS tells no other
  bool has_wrong_flag = false;                ///< what its yaw counts from is told wrongly
  bool tells_set_point = false;               ///< in place of what it measures
  bool is_perfect = false;                    ///< it measures its angles rightly, and shakes by a tenth only
  GimbalTelling telling = GimbalTelling::kDeviceStatus;
};

/// The same flight with a gimbal. It follows its set-point with a lag of 0.15 s (0.4 s in yaw, where it
/// follows the nose), within 160 deg of the nose and 90 deg down to 20 deg up, and is off by 0.1 deg that
/// change within half a second. Ten times a second it tells its angles with noise of 0.03 deg, and an error
/// of 0.04 deg that changes within 3 s, as the autopilot's own roll and pitch on the straight legs of
/// data/flights; its yaw from north is by what the autopilot believes of its own. All figures are 1 sigma,
/// about each axis.
Flight with_gimbal(const Flight& flight, const GimbalSettings& settings, std::uint64_t seed);

}  // namespace geoloc::sim
