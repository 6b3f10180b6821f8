// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/joint_tracker_config.hpp"

#include <algorithm>

#include "geoloc/geometry/problems.hpp"

namespace geoloc {

std::vector<std::string> MovingConfig::problems() const {
  Problems found;
  found.require(
      classes.size() <= 1000 && std::all_of(classes.begin(), classes.end(), [](int id) { return id >= 0; }),
      "joint.moving.classes must be at most 1000 ids >= 0");
  found.require(sigma_acceleration_mps2 > 0.0 && sigma_acceleration_mps2 <= 100.0,
                "joint.moving.sigma_acceleration_mps2 must lie in (0, 100]");
  found.require(sigma_speed_mps > 0.0 && sigma_speed_mps <= 200.0,
                "joint.moving.sigma_speed_mps must lie in (0, 200]");
  found.require(memory_s > 0.0 && memory_s <= 600.0, "joint.moving.memory_s must lie in (0, 600]");
  return found.take();
}

std::vector<std::string> JointTrackerConfig::problems() const {
  Problems found;
  found.add(prior.problems());
  found.add(drift.problems());
  found.add(moving.problems());
  found.require(sigma_px > 0.0 && sigma_px <= 1000.0, "joint.sigma_px must lie in (0, 1000]");
  found.require(sigma_attitude_deg > 0.0 && sigma_attitude_deg <= 30.0,
                "joint.sigma_attitude_deg must lie in (0, 30]");
  found.require(sigma_time_s >= 0.0 && sigma_time_s <= 1.0, "joint.sigma_time_s must lie in [0, 1]");
  found.require(horizontal_accuracy_m > 0.0 && horizontal_accuracy_m <= 1000.0,
                "joint.horizontal_accuracy_m must lie in (0, 1000]");
  found.require(least_offset_sigma_m >= 0.0 && least_offset_sigma_m <= 1000.0,
                "joint.least_offset_sigma_m must lie in [0, 1000]");
  found.require(constant_share >= 0.0 && constant_share < 1.0, "joint.constant_share must lie in [0, 1)");
  found.require(sigma_attitude_bias_deg >= 0.0 && sigma_attitude_bias_deg <= 30.0,
                "joint.sigma_attitude_bias_deg must lie in [0, 30]");
  found.require(sigma_state_lag_s >= 0.0 && sigma_state_lag_s <= 1.0,
                "joint.sigma_state_lag_s must lie in [0, 1]");
  found.require(fast_share >= 0.0 && fast_share <= 1.0, "joint.fast_share must lie in [0, 1]");
  found.require(attitude_time_constant_s >= 0.0 && attitude_time_constant_s <= 100.0,
                "joint.attitude_time_constant_s must lie in [0, 100]");
  found.require(fast_time_constant_s >= 0.0 && fast_time_constant_s <= 100.0,
                "joint.fast_time_constant_s must lie in [0, 100]");
  found.require(gate > 0.0 && gate <= 1000.0, "joint.gate must lie in (0, 1000]");
  found.require(ambiguity >= 0.0 && ambiguity <= 1000.0, "joint.ambiguity must lie in [0, 1000]");
  found.require(class_mismatch_cost >= 0.0, "joint.class_mismatch_cost must be >= 0");
  found.require(duplicate_share >= 0.0 && duplicate_share <= 1.0, "joint.duplicate_share must lie in [0, 1]");
  for (const double probability :
       {detection_probability, birth_probability, confirm_probability, delete_probability}) {
    found.require(probability > 0.0 && probability < 1.0, "joint probabilities must lie in (0, 1)");
  }
  found.require(clutter_per_frame > 0.0 && clutter_per_frame <= 1000.0,
                "joint.clutter_per_frame must lie in (0, 1000]");
  found.require(smallest_object_px >= 0.0, "joint.smallest_object_px must be >= 0");
  found.require(merge_radius_m >= 0.0 && merge_radius_m <= 1000.0,
                "joint.merge_radius_m must lie in [0, 1000]");
  found.require(merge_gate > 0.0 && merge_gate <= 1000.0, "joint.merge_gate must lie in (0, 1000]");
  found.require(max_tracks >= 1 && max_tracks <= 20000, "joint.max_tracks must lie in [1, 20000]");
  found.require(solve_period_s >= 0.0 && solve_period_s <= 60.0, "joint.solve_period_s must lie in [0, 60]");
  return found.take();
}

}  // namespace geoloc
