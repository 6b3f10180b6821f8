// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibration/calibration_fields.hpp"
#include "calibration/drift_fields.hpp"
#include "geoloc/tracking/joint_tracker_config.hpp"
#include "settings/rules.hpp"

namespace geoloc {

template <class Visitor>
void visit_fields(Visitor& v, MovingConfig& moving) {
  v.field("classes", moving.classes, ListRange{Range::at_least(0), 1000}, "",
          "Ids of the classes whose objects may move; all others stand still");
  v.field("sigma_acceleration_mps2", moving.sigma_acceleration_mps2, Range::above(0, 100), "m/s^2",
          "1-sigma per axis of the change of velocity within a second");
  v.field("sigma_speed_mps", moving.sigma_speed_mps, Range::above(0, 200), "m/s",
          "1-sigma per axis of the velocity of an object seen for the first time");
  v.field("memory_s", moving.memory_s, Range::above(0, 600), "s",
          "An object not seen for longer is not recognized again");
}

template <class Visitor>
void visit_noise_fields(Visitor& v, JointTrackerConfig& joint) {
  v.field("sigma_px", joint.sigma_px, Range::above(0, 1000), "px",
          "1-sigma of a box's centre per axis where the detector states none, before any was learnt");
  v.field("sigma_time_s", joint.sigma_time_s, Range::closed(0, 1), "s",
          "1-sigma of a frame's stamp from frame to frame");
  v.field("sigma_attitude_deg", joint.sigma_attitude_deg, Range::above(0, 30), "deg",
          "1-sigma of roll, pitch and yaw from frame to frame, before any was learnt");
  v.field("attitude_time_constant_s", joint.attitude_time_constant_s, Range::closed(0, 100), "s",
          "Frames within it share that noise, as far as the drift's nodes do not follow it");
  v.field("horizontal_accuracy_m", joint.horizontal_accuracy_m, Range::above(0, 1000), "m",
          "1-sigma of the vehicle's position, radial, where the autopilot reports none");
  v.field("constant_share", joint.constant_share, Range::below(0, 1), "",
          "Share of the position's variance that stays constant over a flight; the rest drifts");
  v.field("stated_offset_sigma_m", joint.stated_offset_sigma_m, Range::closed(0, 1000), "m",
          "Least 1-sigma per axis of the constant position error before the drift shows how good the "
          "receiver is: an RTK fix states centimetres against its base, and nothing of where that stands");
  v.field("least_offset_sigma_m", joint.least_offset_sigma_m, Range::closed(0, 1000), "m",
          "Least 1-sigma per axis of the constant position error, whatever the drift shows");
  v.field("fast_share", joint.fast_share, Range::closed(0, 1), "",
          "Share of the position's accuracy that changes from second to second, before any was learnt");
  v.field("fast_time_constant_s", joint.fast_time_constant_s, Range::closed(0, 100), "s",
          "Frames within it share this part of their position noise");
  v.field(
      "sigma_ground_m", joint.sigma_ground_m, Range::closed(0, 1000), "m",
      "1-sigma of the height of an object above or below the ground, level or of a file; 0: all lie on it");
  v.field("sigma_ground_share", joint.sigma_ground_share, Range::closed(0, 1), "",
          "The same over level ground as a share of the camera's height above it; the larger of the two "
          "counts");
  v.field("sigma_attitude_bias_deg", joint.sigma_attitude_bias_deg, Range::closed(0, 30), "deg",
          "1-sigma of the autopilot's own constant error of roll and pitch, which no look can tell from the "
          "camera's");
  v.field("sigma_state_lag_s", joint.sigma_state_lag_s, Range::closed(0, 1), "s",
          "1-sigma of the delay of the autopilot's state by its filter and its link");
}

template <class Visitor>
void visit_association_fields(Visitor& v, JointTrackerConfig& joint) {
  v.field("gate", joint.gate, Range::above(0, 1000), "",
          "Largest squared Mahalanobis distance of an accepted pair; 11.8 holds 99.7 % (chi-square, 2 "
          "degrees of freedom)");
  v.field("ambiguity", joint.ambiguity, Range::closed(0, 1000), "",
          "A look is not used where another explanation of its frame costs less than this more, in the same "
          "units");
  v.field("class_mismatch_cost", joint.class_mismatch_cost, Range::closed(0, Range::kInfinity), "",
          "Added to the squared distance where the classes differ");
  v.field("duplicate_share", joint.duplicate_share, Range::closed(0, 1), "",
          "Detections nearer than this share of their size are one");
}

template <class Visitor>
void visit_life_cycle_fields(Visitor& v, JointTrackerConfig& joint) {
  constexpr Range kProbability = Range::open(0, 1);
  v.field("detection_probability", joint.detection_probability, kProbability, "",
          "Probability that an object in view is detected, before any was counted");
  v.field("clutter_per_frame", joint.clutter_per_frame, Range::above(0, 1000), "",
          "False boxes per frame, before any was counted");
  v.field(
      "birth_probability", joint.birth_probability, kProbability, "",
      "Probability that a detection which fits nothing is an object; less where more false boxes than that "
      "are counted");
  v.field("confirm_probability", joint.confirm_probability, kProbability, "",
          "Probability of existence that confirms an object");
  v.field("delete_probability", joint.delete_probability, kProbability, "",
          "Probability of existence below which an object is removed");
  v.field("smallest_object_px", joint.smallest_object_px, Range::closed(0, 32768), "px",
          "Smaller objects are not expected to be found");
  v.field("merge_radius_m", joint.merge_radius_m, Range::closed(0, 1000), "m",
          "Tracks nearer to each other than this may be one object");
  v.field("merge_gate", joint.merge_gate, Range::above(0, 1000), "",
          "Squared Mahalanobis distance up to which they are one; 11.3 holds 99 % (chi-square, 3 degrees of "
          "freedom)");
  v.field("max_tracks", joint.max_tracks, Range::closed(1, 1000000), "", "Most objects at a time");
}

template <class Visitor>
void visit_fields(Visitor& v, JointTrackerConfig& joint) {
  v.section("prior", joint.prior);
  v.section("drift", joint.drift);
  v.section("moving", joint.moving);
  visit_noise_fields(v, joint);
  visit_association_fields(v, joint);
  visit_life_cycle_fields(v, joint);
  v.field(
      "solve_period_s", joint.solve_period_s, Range::closed(0, 60), "s",
      "Time between two solutions for calibration, drift and covariances; at first every frame is solved");
}

}  // namespace geoloc
