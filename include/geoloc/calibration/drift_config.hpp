// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace geoloc {

/// Errors of the vehicle's state that wander: position as the receiver's solution does, height as the
/// barometer does, yaw as the compass does. They are described at nodes a few seconds apart, straight lines
/// between, with a first-order Gauss-Markov prior from node to node.
struct DriftConfig {
  double node_spacing_s = 3.0;
  double position_time_constant_s = 100.0;
  double ripple_share = 0.2;  ///< of the variance of the position's drift: lasts for seconds only
  double ripple_time_constant_s = 3.0;
  double up_time_constant_s = 30.0;
  double sigma_up_m = 0.2;
  double yaw_time_constant_s = 60.0;
  double sigma_yaw_deg = 0.7;
  int max_nodes = 30;  ///< where there are more, older ones are thinned out, the more the older they are

  // The sway: what position and attitude are off by besides, for a second or so.
  double spell_s = 1.0;  ///< for which it is taken to be constant
  double sway_time_constant_s = 2.0;
  int max_spells = 6;  ///< older ones are frozen at their estimates; 0: the sway is not estimated

  std::vector<std::string> problems() const;
};

}  // namespace geoloc
