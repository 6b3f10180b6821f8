// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/config/geolocator_fields.hpp"

#include <array>
#include <stdexcept>
#include <utility>

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

/// All but the camera, which has a reader of its own.
template <class Visitor>
void visit_fields(Visitor& v, GeolocatorConfig& config) {
  v.field("method", config.method, "paper: one Kalman filter an object");
  v.field("camera_orientation", config.camera_orientation,
          "composed, or added_angles as in the paper's eq. 6 (wrong when the vehicle tilts)");
  v.field("max_detections", config.max_detections, "a frame; of more, the most confident");
  v.section("state", config.state);
  v.section("projector", config.projector);
  v.section("paper", config.paper);
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
  static constexpr std::array<std::pair<Method, const char*>, 1> all{{{Method::kPaper, "paper"}}};
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
  return json;
}

void geolocator_from_json(const nlohmann::json& object, GeolocatorConfig& config,
                          std::vector<std::string>& problems) {
  nlohmann::json rest = object;
  if (object.is_object() && object.contains("camera")) {
    read_camera(object["camera"], config.camera, problems);
    rest.erase("camera");
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
