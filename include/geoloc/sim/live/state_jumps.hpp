// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "geoloc/sim/flight/flight.hpp"

namespace geoloc::sim {

/// What the autopilot is suddenly wrong by, besides what was recorded, while the vehicle flies on.
struct StateJump {
  Eigen::Vector3d position_in_enu = Eigen::Vector3d::Zero();  ///< [m], added to what is told
  double yaw_deg = 0.0;
  double home_up_m = 0.0;  ///< home is set so much higher: heights above it are told lower
  TimeSpan when{};         ///< on the vehicle's clock
};

/// The jumps that are known by a name.
std::vector<std::string> state_jump_names();

/// A jump of the middle of the flight's survey: `glitch` (50 m for 5 s and back), `reset` (3 m), `height`
/// (10 m), `yaw` (20 deg) or `home` (set 3 m lower), each to the end but for the first. Throws
/// std::invalid_argument that lists the names for another one.
StateJump state_jump(const std::string& name, const Trajectory& truth);

/// The flight with the jump in its ATTITUDE, ATTITUDE_QUATERNION, GLOBAL_POSITION_INT and LOCAL_POSITION_NED;
/// the truth stays.
Flight with_jump(const Flight& flight, const StateJump& jump);

}  // namespace geoloc::sim
