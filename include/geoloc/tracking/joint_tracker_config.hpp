// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "geoloc/calibration/calibration.hpp"
#include "geoloc/calibration/drift_config.hpp"

namespace geoloc {

/// Objects that may move; all others are taken to stand still.
struct MovingConfig {
  std::vector<int> classes;  ///< ids; none: nothing moves
  double sigma_acceleration_mps2 = 1.0;
  double sigma_speed_mps = 5.0;  ///< of an object seen for the first time
  double memory_s = 10.0;

  std::vector<std::string> problems() const;
};

/// Settings of JointTracker (docs/settings.md). Sigmas are 1-sigma, per axis where there are several.
struct JointTrackerConfig {
  CalibrationPrior prior;
  DriftConfig drift;
  MovingConfig moving;

  // Noise of one look.
  double sigma_px = 1.5;  ///< of a box's centre
  double sigma_attitude_deg = 0.45;
  double attitude_time_constant_s = 0.6;
  double sigma_time_s = 0.01;           ///< of a frame's stamp
  double horizontal_accuracy_m = 0.85;  ///< radial, where the autopilot reports none
  double constant_share = 0.15;         ///< of the position's variance: constant over a flight
  double stated_offset_sigma_m = 0.04;  ///< at least, of an RTK fix that states next to nothing
  double least_offset_sigma_m = 0.02;   ///< whatever the flight shows
  double fast_share = 0.25;             ///< of the position's accuracy: changes from second to second
  double fast_time_constant_s = 1.0;
  double sigma_ground_m = 3.0;      ///< of an object's height above or below the ground
  double sigma_ground_share = 0.0;  ///< the same over level ground, as a share of the camera's height

  // Constant errors of the autopilot's state, which no look can tell from the camera's.
  double sigma_attitude_bias_deg = 0.12;
  double sigma_state_lag_s = 0.01;

  // Association.
  double gate = 11.8;      ///< squared Mahalanobis distance; chi-square, 2 degrees of freedom, 99.7 %
  double ambiguity = 9.0;  ///< same units
  double class_mismatch_cost = 4.0;
  double duplicate_share = 0.3;  ///< of a detection's size

  // Life cycle.
  double detection_probability = 0.9;  ///< before any was counted
  double clutter_per_frame = 0.1;
  double birth_probability = 0.3;
  double confirm_probability = 0.999;
  double delete_probability = 0.01;
  double smallest_object_px = 6.0;
  double merge_radius_m = 1.5;
  double merge_gate = 11.3;  ///< squared Mahalanobis distance in space; 99 %
  int max_tracks = 1000;

  double solve_period_s = 2.0;

  std::vector<std::string> problems() const;
};

}  // namespace geoloc
