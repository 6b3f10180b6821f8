// SPDX-License-Identifier: Apache-2.0
#include "fleet_rows.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace geoloc::io {
namespace {

using nlohmann::json;

std::string text_of(const json& rows) {
  return rows.dump(-1, ' ', true, json::error_handler_t::replace);
}

json or_null(const std::optional<double>& value) {
  return value ? json(*value) : json();
}

json row_of(const ObjectReport& object, json flights) {
  return {{"id", object.id},
          {"longitude_deg", object.position.longitude_deg},
          {"latitude_deg", object.position.latitude_deg},
          {"class_id", object.class_id},
          {"class_name", object.class_name},
          {"confidence", object.confidence},
          {"hits", object.hits},
          {"first_seen", iso8601(object.first_seen)},
          {"last_seen", iso8601(object.last_seen)},
          {"sigma_major_m", object.ellipse.sigma_major_m},
          {"sigma_minor_m", object.ellipse.sigma_minor_m},
          {"sigma_azimuth_deg", object.ellipse.azimuth_deg},
          {"variance_east_m2", object.covariance_in_enu(0, 0)},
          {"covariance_east_north_m2", object.covariance_in_enu(0, 1)},
          {"variance_north_m2", object.covariance_in_enu(1, 1)},
          {"height_above_home_m", object.height.above_home_m},
          {"sigma_height_m", or_null(object.height.sigma_m)},
          {"height_msl_m", or_null(object.height.msl_m)},
          {"height_ellipsoid_m", or_null(object.height.ellipsoid_m)},
          {"flight_list", std::move(flights)}};
}

/// The flights that the map's object is made of.
json flights_of(const FusedMap& map, std::size_t object) {
  json flights = json::array();
  for (const Contribution& contribution : map.objects[object].contributions)
    flights.push_back(map.flights[contribution.flight].identity.flight);
  return flights;
}

}  // namespace

std::string rows_of_flights(const RunRecord& run) {
  json rows = json::array();
  for (const FlightReport& flight : run.flights)
    rows.push_back({{"flight", flight.flight},
                    {"vehicle", flight.vehicle},
                    {"sequence", flight.sequence},
                    {"verdict", flight.verdict},
                    {"reason", flight.reason},
                    {"objects", flight.objects},
                    {"shared_objects", flight.shared_objects},
                    {"error_east_m", flight.common_error_m.x()},
                    {"error_north_m", flight.common_error_m.y()},
                    {"error_up_m", flight.common_error_m.z()},
                    {"sigma_east_m", flight.sigma_m.x()},
                    {"sigma_north_m", flight.sigma_m.y()},
                    {"sigma_up_m", flight.sigma_m.z()},
                    {"chi2", flight.chi2}});
  return text_of(rows);
}

std::string rows_of_objects(const RunRecord& run) {
  json rows = json::array();
  for (std::size_t i = 0; i < run.objects.size(); ++i) {
    if (!has_place(run.objects[i])) continue;
    rows.push_back(row_of(run.objects[i], run.fused_map ? flights_of(*run.fused_map, i) : json::array()));
  }
  return text_of(rows);
}

std::string rows_of_ids(const ObjectIds& ids) {
  json rows = json::array();
  for (const auto& [flight, objects] : ids.of) {
    for (const auto& [object, id] : objects)
      rows.push_back({{"flight", flight}, {"object", object}, {"id", id}});
  }
  return text_of(rows);
}

}  // namespace geoloc::io
