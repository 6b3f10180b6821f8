// SPDX-License-Identifier: Apache-2.0
#include "fleet/fusion_input.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "fleet/flight_parts.hpp"
#include "fleet/joined_parts.hpp"

namespace geoloc {
namespace {

/// East and north of each flight are estimated at least.
constexpr Eigen::Index kLeastShared = 2;

FusedFlight begin_flight(const FlightSummary& summary) {
  FusedFlight flight;
  flight.identity = summary.identity;
  flight.objects = summary.objects.size();
  return flight;
}

/// Home's height above mean sea level by the first flight that knows it.
std::optional<double> home_of(const Fleet& fleet) {
  for (const auto& [id, summary] : fleet) {
    if (summary.home_height_msl_m) return summary.home_height_msl_m;
  }
  return std::nullopt;
}

FlightSummary in_frame_of(const FusedMap& map, const FlightSummary& summary) {
  FlightSummary moved = transformed_to(*map.frame, summary);
  if (!map.home_height_msl_m || !summary.home_height_msl_m) return moved;
  for (FlightSummary::Object& object : moved.objects)
    object.position_in_enu.z() += *summary.home_height_msl_m - *map.home_height_msl_m;
  return moved;
}

Eigen::Index most_shared(std::size_t flights, const FusionConfig& config) {
  const auto each = static_cast<Eigen::Index>(config.most_unknowns) / static_cast<Eigen::Index>(flights);
  return std::max(kLeastShared, each - 1);  // one more is home's height
}

void take_summaries(const Fleet& fleet, const FusionConfig& config, FusionInput& input, FusedMap& map) {
  for (const auto& [id, summary] : fleet) {
    map.flights.push_back(begin_flight(summary));
    const double away_m = map.frame->to_local(summary.origin).position_in_enu.norm();
    if (away_m <= config.reach_m) {
      input.summaries.push_back(in_frame_of(map, summary));
      input.numbers.push_back(map.flights.size() - 1);
      continue;
    }
    map.flights.back().verdict = FlightVerdict::kTooFar;
    char text[96];
    std::snprintf(text, sizeof(text), "it began %.0f km from the fleet's first flight, beyond %.0f km",
                  away_m / 1e3, config.reach_m / 1e3);
    map.flights.back().reason = text;
  }
}

/// Tells the parts of each other.
void note_parts(const std::vector<std::size_t>& flight, const FusionInput& input, FusedMap& map) {
  std::vector<std::size_t> numbers;
  for (const std::size_t summary : flight) numbers.push_back(input.numbers[summary]);
  for (const std::size_t number : numbers) map.flights[number].parts = numbers;
}

void note_contradiction(const std::vector<std::size_t>& flight, const FusionInput& input, FusedMap& map) {
  for (const std::size_t summary : flight)
    map.flights[input.numbers[summary]].reason =
        "it seems to be part of a flight with others, but what they say of the camera and the receiver "
        "contradicts it: it was taken for a flight by itself";
}

}  // namespace

FusionInput prepare_fusion(const Fleet& fleet, const FusionConfig& config, FusedMap& map) {
  FusionInput input;
  map.frame.emplace(fleet.begin()->second.origin);
  map.home_height_msl_m = home_of(fleet);
  take_summaries(fleet, config, input, map);
  const auto part_model = [&](std::size_t i) {
    const FlightSummary& summary = input.summaries[i];
    const bool has_home = summary.home_height_msl_m.has_value() == map.home_height_msl_m.has_value();
    return PartModel{i, summary,
                     model_of(summary, most_shared(input.summaries.size(), config),
                              has_home ? config.sigma_home_m : config.sigma_no_home_m)};
  };
  const auto add = [&](FleetFlight flight) {
    input.models.push_back(std::move(flight.model));
    input.parts.push_back(std::move(flight.parts));
  };
  for (const std::vector<std::size_t>& flight : flights_of_parts(input.summaries)) {
    std::vector<PartModel> parts;
    for (const std::size_t i : flight) parts.push_back(part_model(i));
    if (parts.size() > 1) {
      if (auto joined = join_parts(parts)) {
        add(*std::move(joined));
        note_parts(flight, input, map);
        continue;
      }
      note_contradiction(flight, input, map);
    }
    for (PartModel& part : parts) add(flight_of(part.number, std::move(part.model)));
  }
  return input;
}

}  // namespace geoloc
