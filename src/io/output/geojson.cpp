// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/geojson.hpp"

#include "json_report.hpp"

namespace geoloc::io {
namespace {

using nlohmann::ordered_json;

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

ordered_json known_points_to_json(const std::vector<KnownPointReport>& reports) {
  auto points = ordered_json::array();
  for (const KnownPointReport& report : reports) {
    ordered_json point{{"id", report.name}, {"status", name_of(report.status)}};
    if (report.status == KnownPointStatus::kMatched) point["object"] = report.object_id;
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace

std::string objects_to_geojson(const std::vector<ObjectReport>& objects, const EstimatorReport& estimator) {
  auto features = ordered_json::array();
  for (const ObjectReport& object : objects) {
    if (has_place(object)) features.push_back(feature_to_json(object));
  }
  ordered_json collection{{"type", "FeatureCollection"},
                          {"method", estimator.calibration ? "joint" : "paper"},
                          {"calibration", calibration_to_json(estimator.calibration)},
                          {"counters", counters_to_json(estimator.counters)}};
  if (!estimator.known_points.empty())
    collection["known_points"] = known_points_to_json(estimator.known_points);
  collection["features"] = std::move(features);
  // Class names come from models and may hold anything; bytes that are not UTF-8 are replaced.
  return collection.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace geoloc::io
