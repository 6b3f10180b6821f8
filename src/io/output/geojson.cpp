// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/geojson.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "geoloc/geometry/angles.hpp"

namespace geoloc::io {
namespace {

using nlohmann::ordered_json;

/// Shortest decimal that reads back as the value to `digits` places, so that text stays short and stable.
double decimals(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

ordered_json to_feature(const ObjectReport& object) {
  const ordered_json coordinates{decimals(object.position.longitude_deg, 9),
                                 decimals(object.position.latitude_deg, 9)};
  return {{"type", "Feature"},
          {"geometry", {{"type", "Point"}, {"coordinates", coordinates}}},
          {"properties",
           {{"id", object.id},
            {"class_id", object.class_id},
            {"class_name", object.class_name},
            {"confidence", decimals(object.confidence, 3)},
            {"hits", object.hits},
            {"first_seen", iso8601(object.first_seen)},
            {"last_seen", iso8601(object.last_seen)},
            {"sigma_major_m", decimals(object.ellipse.sigma_major_m, 4)},
            {"sigma_minor_m", decimals(object.ellipse.sigma_minor_m, 4)},
            {"sigma_azimuth_deg", decimals(object.ellipse.azimuth_deg, 1)}}}};
}

ordered_json to_counters(const RunCounters& counters) {
  return {{"frames", counters.frames},
          {"frames_located", counters.frames_located},
          {"frames_unusable", counters.frames_unusable},
          {"detections", counters.detections},
          {"detections_without_fix", counters.detections_without_fix},
          {"attitudes", counters.attitudes},
          {"positions", counters.positions},
          {"reboots", counters.reboots},
          {"tracks_created", counters.tracks_created},
          {"tracks_removed", counters.tracks_removed},
          {"tracks_merged", counters.tracks_merged}};
}

/// null for a method that learns none.
ordered_json to_calibration(const std::optional<Calibration>& calibration) {
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
  add("height_offset_m", Index::kHeight, 1.0, 4);
  add("offset_east_m", Index::kOffset, 1.0, 4);
  add("offset_north_m", Index::kOffset + 1, 1.0, 4);
  return json;
}

const char* name_of(KnownPointStatus status) {
  switch (status) {
    case KnownPointStatus::kNotCovered:
      return "not covered";
    case KnownPointStatus::kNoObject:
      return "no object agrees";
    case KnownPointStatus::kAmbiguous:
      return "ambiguous";
    case KnownPointStatus::kMatched:
      return "matched";
  }
  return "";
}

ordered_json to_references(const std::vector<ReferenceReport>& reports) {
  auto references = ordered_json::array();
  for (const ReferenceReport& report : reports) {
    ordered_json reference{{"id", report.name}, {"status", name_of(report.status)}};
    if (report.status == KnownPointStatus::kMatched) reference["object"] = report.object_id;
    references.push_back(std::move(reference));
  }
  return references;
}

}  // namespace

std::string objects_to_geojson(const std::vector<ObjectReport>& objects, const EstimatorReport& estimator) {
  auto features = ordered_json::array();
  for (const ObjectReport& object : objects) features.push_back(to_feature(object));
  ordered_json collection{{"type", "FeatureCollection"},
                          {"method", estimator.calibration ? "full" : "paper"},
                          {"calibration", to_calibration(estimator.calibration)},
                          {"counters", to_counters(estimator.counters)}};
  if (!estimator.references.empty()) collection["references"] = to_references(estimator.references);
  collection["features"] = std::move(features);
  // Class names come from models and may hold anything; bytes that are not UTF-8 are replaced.
  return collection.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace geoloc::io
