// SPDX-License-Identifier: Apache-2.0
#include "json_report.hpp"

#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/output/decimals.hpp"

namespace geoloc::io {

using nlohmann::ordered_json;

ordered_json properties_to_json(const ObjectReport& object) {
  ordered_json properties{{"id", object.id},
                          {"class_id", object.class_id},
                          {"class_name", object.class_name},
                          {"confidence", decimals(object.confidence, 3)},
                          {"hits", object.hits},
                          {"first_seen", iso8601(object.first_seen)},
                          {"last_seen", iso8601(object.last_seen)},
                          {"sigma_major_m", decimals(object.ellipse.sigma_major_m, 4)},
                          {"sigma_minor_m", decimals(object.ellipse.sigma_minor_m, 4)},
                          {"sigma_azimuth_deg", decimals(object.ellipse.azimuth_deg, 1)},
                          {"height_above_home_m", decimals(object.height.above_home_m, 3)},
                          {"sigma_height_m", nullptr}};
  if (object.height.sigma_m) properties["sigma_height_m"] = decimals(*object.height.sigma_m, 4);
  if (object.height.msl_m) properties["height_msl_m"] = decimals(*object.height.msl_m, 3);
  if (object.height.ellipsoid_m) properties["height_ellipsoid_m"] = decimals(*object.height.ellipsoid_m, 3);
  if (object.course) {
    properties["speed_mps"] = decimals(object.course->speed_mps, 2);
    properties["course_deg"] = decimals(object.course->direction_deg, 1);
  }
  if (!object.note.name.empty()) properties["operator_name"] = object.note.name;
  if (object.note.verdict != Verdict::kNone) properties["operator_verdict"] = word_of(object.note.verdict);
  return properties;
}

ordered_json feature_to_json(const ObjectReport& object) {
  ordered_json coordinates{decimals(object.position.longitude_deg, 9),
                           decimals(object.position.latitude_deg, 9)};
  if (std::isfinite(object.height.ellipsoid_m.value_or(NAN)))
    coordinates.push_back(decimals(*object.height.ellipsoid_m, 3));
  return {{"type", "Feature"},
          {"geometry", {{"type", "Point"}, {"coordinates", coordinates}}},
          {"properties", properties_to_json(object)}};
}

ordered_json counters_to_json(const RunCounters& counters) {
  return {{"frames", counters.frames},
          {"frames_located", counters.frames_located},
          {"frames_unusable", counters.frames_unusable},
          {"frames_damaged", counters.frames_damaged},
          {"detections", counters.detections},
          {"detections_without_fix", counters.detections_without_fix},
          {"attitudes", counters.attitudes},
          {"positions", counters.positions},
          {"reboots", counters.reboots},
          {"home_moves", counters.home_moves},
          {"position_steps", counters.position_steps},
          {"height_steps", counters.height_steps},
          {"yaw_steps", counters.yaw_steps},
          {"clock_steps", counters.clock_steps},
          {"latency_changes", counters.latency_changes},
          {"frames_turned", counters.frames_turned},
          {"tracks_created", counters.tracks_created},
          {"tracks_removed", counters.tracks_removed},
          {"tracks_merged", counters.tracks_merged},
          {"ranges_used", counters.ranges_used},
          {"ranges_refused", counters.ranges_refused},
          {"detections_at_edge", counters.detections_at_edge},
          {"detections_above_horizon", counters.detections_above_horizon}};
}

ordered_json calibration_to_json(const std::optional<Calibration>& calibration) {
  if (!calibration) return nullptr;
  using Index = CalibrationIndex;
  ordered_json json;
  const auto add = [&](const char* name, int index, double scale, int digits) {
    json[name] = {{"value", decimals(calibration->mean[index] * scale, digits)},
                  {"sigma", decimals(calibration->sigma(index) * scale, digits)}};
  };
  add("boresight_x_deg", Index::kBoresight, kDegPerRad, 4);
  add("boresight_y_deg", Index::kBoresight + 1, kDegPerRad, 4);
  add("boresight_z_deg", Index::kBoresight + 2, kDegPerRad, 4);
  add("latency_s", Index::kLatency, 1.0, 5);
  add("position_lag_s", Index::kPositionLag, 1.0, 5);
  add("height_offset_m", Index::kHeight, 1.0, 4);
  add("offset_east_m", Index::kOffset, 1.0, 4);
  add("offset_north_m", Index::kOffset + 1, 1.0, 4);
  if (calibration->has_unknown_focal())
    json["focal_percent"] = {{"value", decimals(calibration->focal_percent(), 4)},
                             {"sigma", decimals(calibration->sigma_focal_percent(), 4)}};
  return json;
}

}  // namespace geoloc::io
