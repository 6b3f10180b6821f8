// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/json_lines.hpp"

#include <algorithm>

#include "geoloc/io/output/decimals.hpp"
#include "json_report.hpp"

namespace geoloc::io {
namespace {

using nlohmann::ordered_json;

constexpr Duration kTellPeriod = std::chrono::seconds{1};

std::string line(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::int64_t microseconds(HostTime time) {
  return std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
}

/// Longitude, latitude, as in GeoJSON.
ordered_json coordinates(const Geodetic& position) {
  return ordered_json::array({decimals(position.longitude_deg, 9), decimals(position.latitude_deg, 9)});
}

ordered_json to_vehicle(const ViewReport& view) {
  return {{"coordinates", coordinates(view.vehicle)},
          {"height_above_home_m", decimals(view.vehicle_in_enu.z(), 3)},
          {"roll_deg", decimals(view.roll_deg, 3)},
          {"pitch_deg", decimals(view.pitch_deg, 3)},
          {"yaw_deg", decimals(view.yaw_deg, 3)}};
}

ordered_json to_footprint(const ViewReport& view) {
  if (!view.footprint) return nullptr;
  auto corners = ordered_json::array();
  for (const GroundPoint& corner : *view.footprint) corners.push_back(coordinates(corner.position));
  return corners;
}

ordered_json to_pixel(const std::optional<Eigen::Vector2d>& pixel) {
  if (!pixel) return nullptr;
  return {decimals(pixel->x(), 2), decimals(pixel->y(), 2)};
}

ordered_json to_fixes(const std::vector<FixReport>& reports) {
  auto fixes = ordered_json::array();
  for (const FixReport& fix : reports) {
    const Box& box = fix.detection.box;
    fixes.push_back(
        {{"coordinates", coordinates(fix.ground.position)},
         {"class_id", fix.detection.class_id},
         {"confidence", decimals(fix.detection.confidence, 4)},
         {"box", {decimals(box.x, 2), decimals(box.y, 2), decimals(box.width, 2), decimals(box.height, 2)}},
         {"object_id", fix.look.object_id ? ordered_json(*fix.look.object_id) : ordered_json(nullptr)},
         {"expected_px", to_pixel(fix.look.expected_px)},
         {"innovation_px", to_pixel(innovation_px(fix.look, fix.detection))}});
  }
  return fixes;
}

std::string object_line(const ObjectReport& object) {
  ordered_json json{{"type", "object"}};
  json.update(properties_to_json(object));
  json["coordinates"] = coordinates(object.position);
  const Eigen::Matrix2d& covariance = object.covariance_in_enu;
  json["covariance_m2"] = {decimals(covariance(0, 0), 6), decimals(covariance(0, 1), 6),
                           decimals(covariance(1, 1), 6)};
  return line(json);
}

}  // namespace

std::string JsonLines::frame(const OutputFrame& frame) {
  ordered_json json{{"type", "frame"},
                    {"time", iso8601(frame.captured_at)},
                    {"time_us", microseconds(frame.captured_at)},
                    {"located", frame.view.has_value()},
                    {"detections", frame.detections.size()},
                    {"confirmed", frame.objects.size()},
                    {"tentative", frame.tentative.size()},
                    {"frame", frame.number}};
  if (frame.view) {
    json["vehicle"] = to_vehicle(*frame.view);
    json["footprint"] = to_footprint(*frame.view);
    json["fixes"] = to_fixes(frame.fixes);
  }
  std::string lines = line(json);

  std::map<std::uint64_t, Told> present;
  for (const ObjectReport& object : frame.objects) {
    if (!has_place(object)) continue;
    const auto before = told_.find(object.id);
    const bool is_new = before == told_.end();
    const bool was_seen_again =
        !is_new && before->second.hits != object.hits && frame.captured_at - before->second.at >= kTellPeriod;
    if (is_new || was_seen_again) lines += object_line(object);
    present[object.id] = is_new || was_seen_again ? Told{object.hits, frame.captured_at} : before->second;
  }
  for (const auto& [id, told] : told_) {
    if (present.count(id) == 0) lines += line({{"type", "removed"}, {"id", id}, {"status", "retracted"}});
  }
  told_ = std::move(present);
  return lines;
}

std::string JsonLines::status(const LiveStatus& status) {
  return line({{"type", "status"},
               {"time", iso8601(status.at)},
               {"link", status.link},
               {"link_is_good", status.link_is_good},
               {"attitude_rate_hz", decimals(status.attitude_rate_hz, 1)},
               {"position_rate_hz", decimals(status.position_rate_hz, 1)},
               {"video", status.video},
               {"video_is_good", status.video_is_good},
               {"video_rate_hz", decimals(status.video_rate_hz, 1)},
               {"frame_time", status.frame_time},
               {"detect_ms", decimals(status.detect_ms, 1)},
               {"latency_ms", decimals(status.latency_ms, 1)},
               {"frames", status.frames},
               {"frames_unusable", status.frames_unusable},
               {"frames_damaged", status.frames_damaged},
               {"packets_lost", status.packets_lost},
               {"confirmed", status.objects},
               {"tentative", status.tentative},
               {"frames_searched", status.frames_searched},
               {"frames_dropped", status.frames_dropped},
               {"warning", status.warning}});
}

std::string JsonLines::end(const RunRecord& run) {
  std::string lines;
  for (const ObjectReport& object : run.objects) {
    if (has_place(object)) lines += object_line(object);
  }
  return lines + line({{"type", "run"},
                       {"method", run.estimator.calibration ? "joint" : "paper"},
                       {"calibration", calibration_to_json(run.estimator.calibration)},
                       {"counters", counters_to_json(run.estimator.counters)}});
}

}  // namespace geoloc::io
