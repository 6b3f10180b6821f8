// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/fleet/fused_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "geoloc/io/output/decimals.hpp"
#include "io/output/json_report.hpp"

namespace geoloc::io {
namespace {

using nlohmann::ordered_json;

ordered_json feature_of(const FusedMap& map, const FusedObject& fused, const ObjectReport& object) {
  auto flights = ordered_json::array();
  for (const Contribution& contribution : fused.contributions)
    flights.push_back(map.flights[contribution.flight].identity.flight);
  ordered_json feature = feature_to_json(object);
  feature["properties"]["flights"] = std::move(flights);
  return feature;
}

ordered_json three(const Eigen::Vector3d& vector) {
  return {decimals(vector.x(), 4), decimals(vector.y(), 4), decimals(vector.z(), 4)};
}

std::vector<std::string> names_of_parts(const FusedMap& map, const FusedFlight& flight) {
  std::vector<std::string> names;
  for (const std::size_t part : flight.parts) names.push_back(map.flights[part].identity.flight);
  return names;
}

/// Which others a flight is one with; empty: none.
std::string words_of_parts(const FusedMap& map, const FusedFlight& flight) {
  if (flight.parts.empty()) return "";
  return fmt::format("one flight with its other parts: {}", fmt::join(names_of_parts(map, flight), ", "));
}

/// All that a person is to be told of what became of a flight.
std::string words_of(const FusedMap& map, const FusedFlight& flight) {
  const std::string parts = words_of_parts(map, flight);
  return flight.reason + (flight.reason.empty() || parts.empty() ? "" : "; ") + parts;
}

ordered_json flight_to_json(const FusedMap& map, const FusedFlight& flight) {
  ordered_json told{{"flight", flight.identity.flight},
                    {"vehicle", flight.identity.vehicle},
                    {"sequence", flight.identity.sequence},
                    {"verdict", word_of(flight.verdict)},
                    {"reason", flight.reason},
                    {"objects", flight.objects},
                    {"shared_objects", flight.shared_objects},
                    {"common_error_enu_m", three(flight.common_error_m)},
                    {"sigma_enu_m", three(flight.sigma_m)},
                    {"chi2", decimals(flight.chi2, 2)}};
  if (!flight.parts.empty()) told["parts"] = names_of_parts(map, flight);
  return told;
}

}  // namespace

const char* word_of(FlightVerdict verdict) {
  switch (verdict) {
    case FlightVerdict::kFused:
      return "fused";
    case FlightVerdict::kAlone:
      return "alone";
    case FlightVerdict::kDisputed:
      return "disputed";
    case FlightVerdict::kQuarantined:
      return "quarantined";
    case FlightVerdict::kTooFar:
      return "too far";
  }
  return "";
}

std::vector<ObjectReport> report_objects(const FusedMap& map, const std::vector<std::string>& class_names) {
  std::vector<ObjectReport> reports;
  for (const FusedObject& object : map.objects) {
    ObjectReport report;
    report.id = object.id;
    report.class_id = object.class_votes.winner();
    report.class_name = class_name_of(report.class_id, class_names);
    report.confidence = object.existence;
    report.hits = object.hits;
    report.first_seen = object.first_seen;
    report.last_seen = object.last_seen;
    report.position_in_enu = object.position_in_enu.head<2>();
    report.position = map.frame->to_geodetic(report.position_in_enu);
    report.covariance_in_enu = object.covariance.topLeftCorner<2, 2>();
    report.ellipse = error_ellipse(report.covariance_in_enu);
    report.height.above_home_m = object.position_in_enu.z();
    report.height.sigma_m = std::sqrt(object.covariance(2, 2));
    if (map.home_height_msl_m) report.height.msl_m = *map.home_height_msl_m + object.position_in_enu.z();
    reports.push_back(std::move(report));
  }
  return reports;
}

std::vector<FlightReport> report_flights(const FusedMap& map, const Fleet& fleet) {
  std::vector<FlightReport> reports;
  for (const FusedFlight& flight : map.flights) {
    FlightReport report{flight.identity.flight,
                        flight.identity.vehicle,
                        flight.identity.sequence,
                        word_of(flight.verdict),
                        words_of(map, flight),
                        flight.common_error_m,
                        flight.sigma_m,
                        flight.chi2,
                        flight.objects,
                        flight.shared_objects,
                        {}};
    if (flight.verdict != FlightVerdict::kTooFar) {
      const FlightSummary moved = transformed_to(*map.frame, fleet.at(report.flight));
      for (const FlightSummary::Object& object : moved.objects)
        report.places_in_enu.emplace_back(object.position_in_enu.head<2>());
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

std::string fused_to_geojson(const FusedMap& map, const std::vector<ObjectReport>& objects) {
  auto flights = ordered_json::array(), features = ordered_json::array();
  for (const FusedFlight& flight : map.flights) flights.push_back(flight_to_json(map, flight));
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (has_place(objects[i])) features.push_back(feature_of(map, map.objects[i], objects[i]));
  }
  const ordered_json collection{{"type", "FeatureCollection"},
                                {"method", "fused"},
                                {"flights", std::move(flights)},
                                {"features", std::move(features)}};
  return collection.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string flights_to_table(const FusedMap& map) {
  std::size_t width = 6;
  for (const FusedFlight& flight : map.flights) width = std::max(width, flight.identity.flight.size());
  std::string table = fmt::format("{:<{}}  {:<11} {:>7} {:>6}  {:>14} {:>14} {:>14} {:>6}\n", "flight", width,
                                  "verdict", "objects", "shared", "east m", "north m", "up m", "chi2");
  const auto with_sigma = [](double value, double sigma) {
    return fmt::format("{:+.2f} ± {:.2f}", value, sigma);
  };
  for (const FusedFlight& flight : map.flights) {
    const Eigen::Vector3d &error = flight.common_error_m, &sigma = flight.sigma_m;
    fmt::format_to(std::back_inserter(table), "{:<{}}  {:<11} {:>7} {:>6}  {:>14} {:>14} {:>14} {:>6.1f}\n",
                   flight.identity.flight, width, word_of(flight.verdict), flight.objects,
                   flight.shared_objects, with_sigma(error.x(), sigma.x()), with_sigma(error.y(), sigma.y()),
                   with_sigma(error.z(), sigma.z()), flight.chi2);
    if (const std::string words = words_of(map, flight); !words.empty()) table += "    " + words + "\n";
  }
  return table;
}

}  // namespace geoloc::io
