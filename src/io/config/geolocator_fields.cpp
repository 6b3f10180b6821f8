// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/config/geolocator_fields.hpp"

#include <array>
#include <stdexcept>
#include <utility>

#include "geoloc/io/config/known_points_file.hpp"
#include "geoloc/io/json/camera_fields.hpp"
#include "geoloc/io/json/camera_file.hpp"

namespace geoloc {

template <class Visitor>
void visit_fields(Visitor& v, StateConfig& state) {
  v.field("attitude_interpolation", state.attitude_interpolation,
          "slerp, or circular as in the paper's eq. 5");
  v.field("max_gap_s", state.max_gap_s, "s, a longer hole in the telemetry gives no state");
  v.field("max_extrapolation_s", state.max_extrapolation_s, "s, beyond the newest sample");
}

template <class Visitor>
void visit_fields(Visitor& v, ProjectorConfig& projector) {
  v.field("ground_height_above_home_m", projector.ground_height_above_home_m,
          "m, the plane that objects lie on");
  v.field("max_range_m", projector.max_range_m, "m, farther fixes are refused");
  v.field("min_depression_deg", projector.min_depression_deg, "deg, flatter rays are refused");
}

template <class Visitor>
void visit_fields(Visitor& v, PaperTrackerConfig& paper) {
  v.field("measurement_sigma_m", paper.measurement_sigma_m, "m, 1-sigma of one fix an axis");
  v.field("process_sigma_m", paper.process_sigma_m, "m, 1-sigma an axis added at every update");
  v.field("gate", paper.gate, "Mahalanobis distance up to which a pair is accepted");
  v.field("confirm_hits", paper.confirm_hits, "detections that confirm an object");
  v.field("max_penalty", paper.max_penalty, "misses, less hits, that remove an object");
  v.field("visible_margin_px", paper.visible_margin_px, "px, no penalty nearer to the image's edge");
  v.field("merge_distance_m", paper.merge_distance_m, "m, confirmed objects that come closer are merged");
  v.field("max_tracks", paper.max_tracks, "objects at most");
}

template <class Visitor>
void visit_fields(Visitor& v, CalibrationPrior& prior) {
  v.field("boresight_x_deg", prior.boresight_x_deg, "deg, camera turned about its own x (right) axis");
  v.field("boresight_y_deg", prior.boresight_y_deg, "deg, about its y (down) axis");
  v.field("boresight_z_deg", prior.boresight_z_deg, "deg, about its z (forward) axis");
  v.field("latency_s", prior.latency_s, "s, a frame shows the world so long before its stamp");
  v.field("height_m", prior.height_m, "m, camera higher above the ground than reported");
  v.field("sigma_boresight_x_deg", prior.sigma_boresight_x_deg, "deg, 1-sigma; 0 freezes");
  v.field("sigma_boresight_y_deg", prior.sigma_boresight_y_deg, "deg, 1-sigma; 0 freezes");
  v.field("sigma_boresight_z_deg", prior.sigma_boresight_z_deg, "deg, 1-sigma; 0 freezes");
  v.field("sigma_latency_s", prior.sigma_latency_s, "s, 1-sigma; 0 freezes");
  v.field("sigma_height_m", prior.sigma_height_m, "m, 1-sigma; 0 freezes");
}

template <class Visitor>
void visit_fields(Visitor& v, DriftConfig& drift) {
  v.field("node_spacing_s", drift.node_spacing_s, "s between the nodes of the drift");
  v.field("position_time_constant_s", drift.position_time_constant_s,
          "s, how fast the position error wanders");
  v.field("yaw_time_constant_s", drift.yaw_time_constant_s, "s, how fast the yaw error wanders");
  v.field("sigma_yaw_deg", drift.sigma_yaw_deg, "deg, 1-sigma of the wandering");
  v.field("max_nodes", drift.max_nodes, "older ones are frozen");
}

template <class Visitor>
void visit_fields(Visitor& v, MovingConfig& moving) {
  v.field("classes", moving.classes, "ids of the classes whose objects may move; the others stand still");
  v.field("sigma_acceleration_mps2", moving.sigma_acceleration_mps2,
          "m/s^2, 1-sigma an axis of what changes their velocity within a second");
  v.field("sigma_speed_mps", moving.sigma_speed_mps, "m/s, 1-sigma an axis of one seen for the first time");
  v.field("memory_s", moving.memory_s, "s, one not seen for longer is not recognized again");
}

template <class Visitor>
void visit_fields(Visitor& v, JointTrackerConfig& joint) {
  v.section("prior", joint.prior);
  v.section("drift", joint.drift);
  v.section("moving", joint.moving);
  v.field("sigma_px", joint.sigma_px, "px, 1-sigma of a box's centre, an axis");
  v.field("sigma_time_s", joint.sigma_time_s, "s, of a frame's stamp, from frame to frame");
  v.field("sigma_attitude_deg", joint.sigma_attitude_deg, "deg, 1-sigma from frame to frame");
  v.field("attitude_time_constant_s", joint.attitude_time_constant_s,
          "s, frames within it share that, as far as drift does not follow it");
  v.field("horizontal_accuracy_m", joint.horizontal_accuracy_m,
          "m, radial, where the autopilot reports none");
  v.field("constant_share", joint.constant_share, "of its variance, what stays constant over a flight");
  v.field("least_offset_sigma_m", joint.least_offset_sigma_m,
          "m, 1-sigma an axis of the constant position error at least");
  v.field("fast_share", joint.fast_share, "of the accuracy, what changes from second to second");
  v.field("fast_time_constant_s", joint.fast_time_constant_s, "s, frames within it share their noise");
  v.field("sigma_attitude_bias_deg", joint.sigma_attitude_bias_deg, "deg, the autopilot's own, 1-sigma");
  v.field("sigma_state_lag_s", joint.sigma_state_lag_s, "s, the autopilot's own, 1-sigma");
  v.field("gate", joint.gate, "squared Mahalanobis distance up to which a pair is accepted");
  v.field(
      "ambiguity", joint.ambiguity,
      "in the same units, how much worse another explanation of a frame may be and still be held possible");
  v.field("class_mismatch_cost", joint.class_mismatch_cost, "added to it where the classes differ");
  v.field("duplicate_share", joint.duplicate_share, "of their size: detections nearer than this are one");
  v.field("detection_probability", joint.detection_probability, "before any was counted");
  v.field("clutter_per_frame", joint.clutter_per_frame, "false boxes");
  v.field("birth_probability", joint.birth_probability, "that a new detection is an object");
  v.field("confirm_probability", joint.confirm_probability, "existence that confirms an object");
  v.field("delete_probability", joint.delete_probability, "existence that removes it");
  v.field("smallest_object_px", joint.smallest_object_px, "px, smaller ones are not expected to be found");
  v.field("merge_radius_m", joint.merge_radius_m, "m, tracks that are nearer may be one object");
  v.field("merge_gate", joint.merge_gate, "squared Mahalanobis distance up to which they are");
  v.field("max_tracks", joint.max_tracks, "objects at most");
  v.field("solve_period_s", joint.solve_period_s, "s between solutions for calibration and drift");
}

/// All but the camera, which has a reader of its own.
template <class Visitor>
void visit_fields(Visitor& v, GeolocatorConfig& config) {
  v.field("method", config.method,
          "joint: objects, calibration and drift together; paper: one Kalman filter an object");
  v.field("camera_orientation", config.camera_orientation,
          "composed, or added_angles as in the paper's eq. 6 (wrong when the vehicle tilts)");
  v.field("max_detections", config.max_detections, "a frame; of more, the most confident");
  v.field("edge_margin_px", config.edge_margin_px,
          "px, boxes nearer to the image's edge are not used; 0: all are");
  v.section("state", config.state);
  v.section("projector", config.projector);
  v.section("paper", config.paper);
  v.section("joint", config.joint);
}

namespace io {

template <>
struct EnumNames<AttitudeInterpolation> {
  static constexpr std::array<std::pair<AttitudeInterpolation, const char*>, 2> all{
      {{AttitudeInterpolation::kCircular, "circular"}, {AttitudeInterpolation::kSlerp, "slerp"}}};
};

template <>
struct EnumNames<CameraOrientation> {
  static constexpr std::array<std::pair<CameraOrientation, const char*>, 2> all{
      {{CameraOrientation::kComposed, "composed"}, {CameraOrientation::kAddedAngles, "added_angles"}}};
};

template <>
struct EnumNames<Method> {
  static constexpr std::array<std::pair<Method, const char*>, 2> all{
      {{Method::kPaper, "paper"}, {Method::kJoint, "joint"}}};
};

namespace {

void read_camera(const nlohmann::json& value, CameraConfig& camera, std::vector<std::string>& problems) {
  if (!value.is_string()) return camera_from_json(value, "camera", true, camera, problems);
  try {
    camera = read_camera_file(value.get<std::string>(), camera);
  } catch (const std::runtime_error& error) {
    problems.push_back(std::string("camera: ") + error.what());
  }
}

}  // namespace

nlohmann::ordered_json geolocator_to_json(const GeolocatorConfig& config) {
  FieldWriter writer;
  GeolocatorConfig copy = config;  // one description serves reading and writing, so it takes mutable fields
  visit_fields(writer, copy);
  auto json = writer.take();
  json["camera"] = camera_to_json(config.camera);
  json["known_points"] = known_points_to_json(config.known_points);
  return json;
}

void geolocator_from_json(const nlohmann::json& object, GeolocatorConfig& config,
                          std::vector<std::string>& problems) {
  nlohmann::json rest = object;
  if (object.is_object() && object.contains("camera")) {
    read_camera(object["camera"], config.camera, problems);
    rest.erase("camera");
  }
  if (object.is_object() && object.contains("known_points")) {
    known_points_from_json(object["known_points"], config.known_points, problems);
    rest.erase("known_points");
  }
  FieldReader reader(rest, "", problems);
  visit_fields(reader, config);
  reader.refuse_unknown();
  const auto out_of_range = config.problems();
  problems.insert(problems.end(), out_of_range.begin(), out_of_range.end());
}

std::vector<FieldLine> geolocator_field_lines() {
  std::vector<FieldLine> lines;
  FieldLister lister(lines);
  GeolocatorConfig defaults;
  visit_fields(lister, defaults);
  return lines;
}

}  // namespace io
}  // namespace geoloc
