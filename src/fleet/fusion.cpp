// SPDX-License-Identifier: Apache-2.0
#include "geoloc/fleet/fusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "fleet/association.hpp"
#include "fleet/common_errors.hpp"
#include "fleet/fusion_input.hpp"
#include "fleet/map_merges.hpp"
#include "fleet/map_solver.hpp"
#include "geoloc/geometry/problems.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "geometry/symmetric.hpp"

namespace geoloc {
namespace {

/// Times that neighbours on the map are compared.
constexpr int kMergeRounds = 3;

/// In the order of the summaries.
std::vector<AssociatedFlight> flights_to_associate(const FusionInput& input) {
  std::vector<std::size_t> flight_of_summary(input.summaries.size());
  std::vector<const FlightPart*> part_of_summary(input.summaries.size());
  for (std::size_t flight = 0; flight < input.parts.size(); ++flight) {
    for (const FlightPart& part : input.parts[flight]) {
      flight_of_summary[part.summary] = flight;
      part_of_summary[part.summary] = &part;
    }
  }
  std::vector<AssociatedFlight> flights;
  for (std::size_t i = 0; i < input.summaries.size(); ++i) {
    std::vector<int> classes;
    for (const FlightSummary::Object& object : input.summaries[i].objects)
      classes.push_back(object.class_votes.winner());
    const std::size_t flight = flight_of_summary[i];
    flights.push_back({flight, input.models[flight], *part_of_summary[i], std::move(classes)});
  }
  return flights;
}

void merge_all(const FusionInput& input, const FusionConfig& config, std::vector<Members>& objects,
               MapEstimate& estimate) {
  for (int i = 0; i < kMergeRounds; ++i) {
    if (!merge_neighbours(input, estimate, config, objects)) return;
    estimate = solve_map(input.models, objects);
  }
}

/// The flight that disagrees most with the others, of those that at least two others can be held against.
std::optional<std::size_t> worst_flight(const std::vector<CommonError>& errors, double gate) {
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i].other_flights < 2 || !(errors[i].chi2 > gate)) continue;
    if (!worst || errors[i].chi2 > errors[*worst].chi2) worst = i;
  }
  return worst;
}

void take_out(std::size_t flight, std::vector<Members>& objects) {
  for (Members& members : objects) {
    members.erase(std::remove_if(members.begin(), members.end(),
                                 [&](const Contribution& member) { return member.flight == flight; }),
                  members.end());
    for (Contribution& member : members) {
      if (member.flight > flight) --member.flight;
    }
  }
  drop_empty(objects);
}

std::string disagreement(const CommonError& error, const char* with) {
  char text[160];
  std::snprintf(text, sizeof(text),
                "its objects lie %.1f m east and %.1f m north of where %s has them (chi-square %.0f)",
                error.mean_m.x(), error.mean_m.y(), with, error.chi2);
  return text;
}

void report(const CommonError& error, const PartError& of_part, FusedFlight& flight) {
  flight.common_error_m = of_part.mean_m;
  flight.sigma_m = of_part.sigma_m;
  flight.chi2 = error.chi2;
  flight.shared_objects = of_part.shared_objects;
}

/// A flight that disagrees with the rest of the fleet: its objects are taken out of the map.
void quarantine(std::size_t i, const CommonError& error, FusionInput& input, std::vector<Members>& objects,
                FusedMap& map) {
  for (std::size_t part = 0; part < input.parts[i].size(); ++part) {
    FusedFlight& flight = map.flights[input.numbers[input.parts[i][part].summary]];
    report(error, error.parts[part], flight);
    flight.verdict = FlightVerdict::kQuarantined;
    flight.reason = disagreement(error, "the rest of the fleet");
  }
  input.erase(i);
  take_out(i, objects);
}

void judge(const CommonError& error, const PartError& of_part, const FusionConfig& config,
           FusedFlight& flight) {
  report(error, of_part, flight);
  if (error.other_flights == 0) {
    flight.verdict = FlightVerdict::kAlone;
    flight.reason = "it shares no object with another flight: nothing checks it";
  } else if (error.chi2 > config.quarantine_gate) {
    flight.verdict = FlightVerdict::kDisputed;
    flight.reason = disagreement(error, "the map") + "; a third flight would tell which of the two is wrong";
  } else {
    flight.verdict = FlightVerdict::kFused;
  }
}

FusedObject fused_object(std::uint64_t id, const Members& members, const MapEstimate::Place& place,
                         const FusionInput& input) {
  FusedObject fused;
  fused.id = id;
  fused.position_in_enu = place.position;
  fused.covariance = symmetric(place.covariance);
  double absent = 1.0;
  for (const Contribution& member : members) {
    const FlightPart& part = input.part_of(member);
    const std::size_t own = member.object - part.first_object;
    const FlightSummary::Object& object = input.summaries[part.summary].objects[own];
    const bool is_first = fused.contributions.empty();
    fused.first_seen = is_first ? object.first_seen : std::min(fused.first_seen, object.first_seen);
    fused.last_seen = is_first ? object.last_seen : std::max(fused.last_seen, object.last_seen);
    fused.hits += object.hits;
    fused.class_votes.add(object.class_votes);
    absent *= 1.0 - object.existence;
    fused.contributions.push_back({input.numbers[part.summary], own});
  }
  fused.existence = 1.0 - absent;
  return fused;
}

}  // namespace

bool take(FlightSummary summary, Fleet& fleet) {
  const std::string flight = summary.identity.flight;
  const auto found = fleet.find(flight);
  if (found != fleet.end() && found->second.identity.sequence >= summary.identity.sequence) return false;
  fleet.insert_or_assign(flight, std::move(summary));
  return true;
}

std::vector<std::string> FusionConfig::problems() const {
  Problems problems;
  const auto is_positive = [](double value) { return value > 0.0 && value <= 1e6; };
  problems.require(is_positive(sigma_home_m), "sigma_home_m must be above 0");
  problems.require(is_positive(sigma_no_home_m), "sigma_no_home_m must be above 0");
  problems.require(sigma_object_m >= 0.0 && sigma_object_m <= 1e3,
                   "sigma_object_m must be between 0 and 1000");
  problems.require(is_positive(gate), "gate must be above 0");
  problems.require(most_shift_m >= 0.0 && most_shift_m <= 1e3, "most_shift_m must be between 0 and 1000");
  problems.require(is_positive(quarantine_gate), "quarantine_gate must be above 0");
  problems.require(reach_m > 0.0 && reach_m <= 50e3, "reach_m must be above 0 and at most 50000");
  problems.require(most_unknowns >= 3 && most_unknowns <= 20'000,
                   "most_unknowns must be between 3 and 20000");
  return problems.take();
}

FusedMap fuse(const Fleet& fleet, const FusionConfig& config) {
  refuse_if_any(config.problems());
  FusedMap map;
  if (fleet.empty()) return map;
  FusionInput input = prepare_fusion(fleet, config, map);

  std::vector<Members> objects = associate(flights_to_associate(input), config);
  MapEstimate estimate = solve_map(input.models, objects);
  merge_all(input, config, objects, estimate);
  std::vector<CommonError> errors = common_errors(input, objects, estimate);
  while (const auto worst = worst_flight(errors, config.quarantine_gate)) {
    quarantine(*worst, errors[*worst], input, objects, map);
    estimate = solve_map(input.models, objects);
    errors = common_errors(input, objects, estimate);
  }
  for (std::size_t i = 0; i < errors.size(); ++i) {
    for (std::size_t part = 0; part < input.parts[i].size(); ++part)
      judge(errors[i], errors[i].parts[part], config,
            map.flights[input.numbers[input.parts[i][part].summary]]);
  }
  for (std::size_t i = 0; i < objects.size(); ++i)
    map.objects.push_back(fused_object(i + 1, objects[i], estimate.objects[i], input));
  return map;
}

}  // namespace geoloc
