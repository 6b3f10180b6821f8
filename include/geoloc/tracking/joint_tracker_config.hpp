// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "geoloc/calibration/calibration.hpp"
#include "geoloc/calibration/drift_config.hpp"

namespace geoloc {

/// Of objects that may move; all others are taken to stand still.
struct MovingConfig {
  std::vector<int> classes;              ///< ids; none: nothing moves
  double sigma_acceleration_mps2 = 1.0;  ///< 1-sigma an axis of what changes their velocity within a second
  double sigma_speed_mps = 5.0;          ///< of one seen for the first time, an axis
  double memory_s = 10.0;                ///< one not seen for longer is not recognized again

  std::vector<std::string> problems() const;
};

struct JointTrackerConfig {
  CalibrationPrior prior;
  DriftConfig drift;
  MovingConfig moving;

  // Noise of one look.
  double sigma_px = 1.5;            ///< of a box's centre, an axis
  double sigma_attitude_deg = 0.1;  ///< of roll, pitch and yaw from frame to frame
  double attitude_time_constant_s =
      0.6;                     ///< frames within it share that, as far as the drift's nodes do not follow it
  double sigma_time_s = 0.01;  ///< of a frame's stamp, from frame to frame
  double horizontal_accuracy_m =
      0.85;  ///< of the vehicle's position, where the autopilot reports none (radial, 1-sigma)
  double constant_share = 0.15;  ///< of its variance, what stays constant over a flight; the rest wanders
  double least_offset_sigma_m =
      0.02;                  ///< of the constant position error, an axis, whatever the wandering shows
  double fast_share = 0.25;  ///< of it, what changes from second to second
  double fast_time_constant_s = 1.0;  ///< frames within it share their attitude and position noise

  // Constant errors of the autopilot's state, which no look can tell from the camera's.
  double sigma_attitude_bias_deg = 0.12;  ///< of roll and pitch
  double sigma_state_lag_s = 0.01;        ///< state shown late by its filter and its link

  // Association.
  double gate = 11.8;      ///< squared Mahalanobis distance; chi-square, 2 degrees of freedom, 99.7 %
  double ambiguity = 9.0;  ///< a look is not used where its frame can be explained otherwise, and less than
                           ///< this worse in the same units
  double class_mismatch_cost = 4.0;  ///< added to it where the classes differ
  double duplicate_share = 0.3;      ///< detections nearer than this share of their size are one

  // Life cycle.
  double detection_probability = 0.9;  ///< before any was counted
  double clutter_per_frame = 0.1;      ///< false boxes
  double birth_probability = 0.3;      ///< that a detection which fits nothing is an object
  double confirm_probability = 0.999;
  double delete_probability = 0.01;
  double smallest_object_px = 6.0;  ///< smaller ones are not expected to be found
  double merge_radius_m = 1.5;      ///< tracks nearer than this may be one object
  double merge_gate = 9.2;          ///< squared Mahalanobis distance; 99 %
  int max_tracks = 1000;

  double solve_period_s = 2.0;  ///< of calibration, drift and covariances; every frame at first

  std::vector<std::string> problems() const;
};

}  // namespace geoloc
