// SPDX-License-Identifier: Apache-2.0
#include "page_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/live_page/coordinate_texts.hpp"
#include "geoloc/io/output/decimals.hpp"

namespace geoloc::io::page_json {
namespace {

using nlohmann::ordered_json;

ordered_json point(const Eigen::Vector2d& position_in_enu) {
  return {decimals(position_in_enu.x(), 3), decimals(position_in_enu.y(), 3)};
}

std::string text_of(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

ordered_json calibration(const Calibration& calibration) {
  using Index = CalibrationIndex;
  auto rows = ordered_json::array();
  const auto add_row = [&](const char* name, const char* unit, double value, double sigma, int digits) {
    rows.push_back({{"name", name},
                    {"unit", unit},
                    {"value", decimals(value, digits)},
                    {"sigma", decimals(sigma, digits)},
                    {"digits", digits}});
  };
  const auto add = [&](const char* name, const char* unit, int index, double scale, int digits) {
    add_row(name, unit, calibration.mean[index] * scale, calibration.sigma(index) * scale, digits);
  };
  add("Image delay", "ms", Index::kLatency, 1e3, 1);
  add("Delay of the vehicle's position", "ms", Index::kPositionLag, 1e3, 1);
  add("Camera turned about its x axis", "°", Index::kBoresight, kDegPerRad, 3);
  add("Camera turned about its y axis", "°", Index::kBoresight + 1, kDegPerRad, 3);
  add("Camera turned about its z axis", "°", Index::kBoresight + 2, kDegPerRad, 3);
  if (calibration.has_unknown_focal())
    add_row("Error of the focal length", "%", calibration.focal_percent(), calibration.sigma_focal_percent(),
            2);
  add("Error of the vehicle's height", "m", Index::kHeight, 1.0, 3);
  add("Error of the vehicle's position, east", "m", Index::kOffset, 1.0, 3);
  add("Error of the vehicle's position, north", "m", Index::kOffset + 1, 1.0, 3);
  return rows;
}

}  // namespace

std::int64_t milliseconds(HostTime time) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
}

void append(std::string& object, const std::string& name, const std::string& json) {
  object += object.empty() ? "{\"" : ",\"";
  object += name;
  object += "\":";
  object += json;
}

std::string title(const LivePageTitle& title) {
  return text_of({{"name", title.name}, {"is_live", title.is_live}, {"is_fleet", title.is_fleet}});
}

std::string status(const LiveStatus& status) {
  return text_of({{"elapsed_s", decimals(seconds(status.elapsed), 1)},
                  {"link", status.link},
                  {"link_is_good", status.link_is_good},
                  {"attitude_hz", decimals(status.attitude_rate_hz, 1)},
                  {"position_hz", decimals(status.position_rate_hz, 1)},
                  {"video", status.video},
                  {"video_is_good", status.video_is_good},
                  {"video_state", status.video_state},
                  {"video_hz", decimals(status.video_rate_hz, 1)},
                  {"frame_time", status.frame_time},
                  {"warning", status.warning},
                  {"fleet", status.fleet},
                  {"detect_ms", decimals(status.detect_ms, 1)},
                  {"latency_ms", decimals(status.latency_ms, 1)}});
}

std::string view(const OutputFrame& frame) {
  ordered_json json{{"at", milliseconds(frame.captured_at)}};
  const ViewReport& view = *frame.view;
  json["vehicle"] = point(view.vehicle_in_enu.head<2>());
  json["height_m"] = decimals(view.vehicle_in_enu.z(), 2);
  json["yaw_deg"] = decimals(view.yaw_deg, 1);
  if (view.footprint) {
    auto corners = ordered_json::array();
    for (const GroundPoint& corner : *view.footprint) corners.push_back(point(corner.position_in_enu));
    json["footprint"] = std::move(corners);
  }
  return text_of(json);
}

std::string targets(const std::vector<Eigen::Vector2d>& positions_in_enu) {
  constexpr std::size_t kMost = 2000;
  auto list = ordered_json::array();
  for (std::size_t i = 0; i < std::min(positions_in_enu.size(), kMost); ++i)
    list.push_back(point(positions_in_enu[i]));
  return text_of(list);
}

std::string picture(const LivePicture& picture, std::uint64_t number,
                    const std::vector<std::string>& class_names) {
  auto boxes = ordered_json::array();
  for (const Detection& detection : picture.detections) {
    const Box& box = detection.box;
    const auto name = static_cast<std::size_t>(detection.class_id);
    boxes.push_back(
        {{"box", {decimals(box.x, 1), decimals(box.y, 1), decimals(box.width, 1), decimals(box.height, 1)}},
         {"confidence", decimals(detection.confidence, 2)},
         {"name",
          name < class_names.size() ? class_names[name] : "class " + std::to_string(detection.class_id)}});
  }
  return text_of({{"number", number},
                  {"at", milliseconds(picture.captured_at)},
                  {"width_px", picture.frame_width_px},
                  {"height_px", picture.frame_height_px},
                  {"boxes", std::move(boxes)}});
}

std::string settings(const LivePageConfig& config, bool may_change) {
  return text_of({{"tile_url", config.tile_url},
                  {"tile_attribution", config.tile_attribution},
                  {"may_change", may_change}});
}

std::string anchor(const ViewReport& view) {
  return text_of({{"latitude_deg", view.vehicle.latitude_deg},
                  {"longitude_deg", view.vehicle.longitude_deg},
                  {"at", point(view.vehicle_in_enu.head<2>())}});
}

std::string anchor(const Geodetic& origin) {
  return text_of({{"latitude_deg", origin.latitude_deg},
                  {"longitude_deg", origin.longitude_deg},
                  {"at", point(Eigen::Vector2d::Zero())}});
}

std::string flights(const std::vector<FlightReport>& reports) {
  constexpr std::size_t kMostPlaces = 20'000;  // of all flights; a page draws no more
  std::size_t places = 0;
  auto list = ordered_json::array();
  for (const FlightReport& report : reports) {
    auto at = ordered_json::array();
    for (const Eigen::Vector2d& place : report.places_in_enu) {
      if (places++ < kMostPlaces) at.push_back(point(place));
    }
    const Eigen::Vector3d &error = report.common_error_m, &sigma = report.sigma_m;
    list.push_back({{"flight", report.flight},
                    {"verdict", report.verdict},
                    {"reason", report.reason},
                    {"error_m", {decimals(error.x(), 3), decimals(error.y(), 3), decimals(error.z(), 3)}},
                    {"sigma_m", {decimals(sigma.x(), 3), decimals(sigma.y(), 3), decimals(sigma.z(), 3)}},
                    {"objects", report.objects},
                    {"shared", report.shared_objects},
                    {"at", std::move(at)}});
  }
  return text_of(list);
}

std::string estimator(const EstimatorReport& report) {
  const RunCounters& counters = report.counters;
  ordered_json json{{"counters",
                     {{"Frames", counters.frames},
                      {"Frames located", counters.frames_located},
                      {"Frames without state", counters.frames_unusable},
                      {"Frames damaged", counters.frames_damaged},
                      {"Detections", counters.detections},
                      {"Without ground point", counters.detections_without_fix},
                      {"Attitudes", counters.attitudes},
                      {"Positions", counters.positions},
                      {"Reboots", counters.reboots},
                      {"Jumps of the position", counters.position_steps},
                      {"Jumps of the height", counters.height_steps},
                      {"Jumps of the yaw", counters.yaw_steps},
                      {"Jumps of home", counters.home_moves},
                      {"Clock steps", counters.clock_steps},
                      {"Latency changes", counters.latency_changes},
                      {"Frames turned", counters.frames_turned},
                      {"Tracks made", counters.tracks_created},
                      {"Tracks removed", counters.tracks_removed},
                      {"Tracks merged", counters.tracks_merged}}}};
  if (report.calibration) json["calibration"] = calibration(*report.calibration);
  return text_of(json);
}

std::string object(const ObjectReport& object, bool is_confirmed, std::uint64_t picture) {
  ordered_json json{{"id", object.id},
                    {"confirmed", is_confirmed},
                    {"name", object.class_name},
                    {"class", object.class_id},
                    {"at", point(object.position_in_enu)},
                    {"latitude_deg", decimals(object.position.latitude_deg, 8)},
                    {"longitude_deg", decimals(object.position.longitude_deg, 8)},
                    {"major_m", decimals(object.ellipse.sigma_major_m, 3)},
                    {"minor_m", decimals(object.ellipse.sigma_minor_m, 3)},
                    {"azimuth_deg", decimals(object.ellipse.azimuth_deg, 0)},
                    {"height_m", decimals(object.height.above_home_m, 2)},
                    {"confidence", decimals(object.confidence, 3)},
                    {"hits", object.hits},
                    {"first_seen", milliseconds(object.first_seen)},
                    {"last_seen", milliseconds(object.last_seen)}};
  if (picture > 0) json["picture"] = picture;
  if (object.height.sigma_m) json["sigma_height_m"] = decimals(*object.height.sigma_m, 3);
  if (object.course) {
    json["speed_mps"] = decimals(object.course->speed_mps, 2);
    json["course_deg"] = decimals(object.course->direction_deg, 0);
  }
  if (object.height.msl_m) json["height_msl_m"] = decimals(*object.height.msl_m, 1);
  if (object.height.ellipsoid_m) json["height_ellipsoid_m"] = decimals(*object.height.ellipsoid_m, 1);
  if (!object.note.name.empty()) json["operator_name"] = object.note.name;
  if (object.note.verdict != Verdict::kNone) json["verdict"] = word_of(object.note.verdict);
  return text_of(json);
}

std::string details(const ObjectReport& report, const std::string& object_json,
                    const std::string& history_json) {
  const CoordinateTexts texts = coordinate_texts(report.position);
  std::string json;
  append(json, "object", object_json);
  append(json, "coordinates",
         text_of({{"degrees", texts.degrees}, {"dms", texts.dms}, {"utm", texts.utm}, {"mgrs", texts.mgrs}}));
  append(json, "history", history_json);
  return json + "}";
}

}  // namespace geoloc::io::page_json
