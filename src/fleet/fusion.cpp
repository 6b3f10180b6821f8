// SPDX-License-Identifier: Apache-2.0
#include "geoloc/fleet/fusion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "fleet/association.hpp"
#include "fleet/common_errors.hpp"
#include "fleet/flight_model.hpp"
#include "fleet/map_merges.hpp"
#include "fleet/map_solver.hpp"
#include "geoloc/geometry/problems.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "geometry/symmetric.hpp"

namespace geoloc {
namespace {

/// Times that neighbours on the map are compared.
constexpr int kMergeRounds = 3;
/// East and north of each flight are estimated at least.
constexpr Eigen::Index kLeastShared = 2;

/// Flights in the fleet's frame, and which of FusedMap::flights each is.
struct Input {
  std::vector<FlightSummary> summaries;
  std::vector<FlightModel> models;
  std::vector<std::size_t> numbers;

  std::size_t size() const { return models.size(); }
  void erase(std::size_t i) {
    summaries.erase(summaries.begin() + static_cast<std::ptrdiff_t>(i));
    models.erase(models.begin() + static_cast<std::ptrdiff_t>(i));
    numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(i));
  }
};

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

Input prepare(const Fleet& fleet, const FusionConfig& config, FusedMap& map) {
  Input input;
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
  for (const FlightSummary& summary : input.summaries) {
    const bool has_home = summary.home_height_msl_m.has_value() == map.home_height_msl_m.has_value();
    input.models.push_back(model_of(summary, most_shared(input.summaries.size(), config),
                                    has_home ? config.sigma_home_m : config.sigma_no_home_m));
  }
  return input;
}

std::vector<Members> associate(const Input& input, const FusionConfig& config) {
  std::vector<AssociatedFlight> flights;
  for (std::size_t i = 0; i < input.size(); ++i) {
    std::vector<int> classes;
    for (const FlightSummary::Object& object : input.summaries[i].objects)
      classes.push_back(object.class_votes.winner());
    flights.push_back({input.models[i], std::move(classes)});
  }
  return associate(flights, config);
}

void merge_all(const Input& input, const FusionConfig& config, std::vector<Members>& objects,
               MapEstimate& estimate) {
  std::vector<const FlightSummary*> summaries;
  for (const FlightSummary& summary : input.summaries) summaries.push_back(&summary);
  for (int i = 0; i < kMergeRounds; ++i) {
    if (!merge_neighbours(summaries, input.models, estimate, config, objects)) return;
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

void report(const CommonError& error, FusedFlight& flight) {
  flight.common_error_m = error.mean_m;
  flight.sigma_m = error.sigma_m;
  flight.chi2 = error.chi2;
  flight.shared_objects = error.shared_objects;
}

/// A flight that disagrees with the rest of the fleet: its objects are taken out of the map.
void quarantine(std::size_t i, const CommonError& error, Input& input, std::vector<Members>& objects,
                FusedMap& map) {
  FusedFlight& flight = map.flights[input.numbers[i]];
  report(error, flight);
  flight.verdict = FlightVerdict::kQuarantined;
  flight.reason = disagreement(error, "the rest of the fleet");
  input.erase(i);
  take_out(i, objects);
}

void judge(const CommonError& error, const FusionConfig& config, FusedFlight& flight) {
  report(error, flight);
  if (error.shared_objects == 0) {
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
                         const Input& input) {
  FusedObject fused;
  fused.id = id;
  fused.position_in_enu = place.position;
  fused.covariance = symmetric(place.covariance);
  double absent = 1.0;
  for (const Contribution& member : members) {
    const FlightSummary::Object& object = input.summaries[member.flight].objects[member.object];
    const bool is_first = fused.contributions.empty();
    fused.first_seen = is_first ? object.first_seen : std::min(fused.first_seen, object.first_seen);
    fused.last_seen = is_first ? object.last_seen : std::max(fused.last_seen, object.last_seen);
    fused.hits += object.hits;
    fused.class_votes.add(object.class_votes);
    absent *= 1.0 - object.existence;
    fused.contributions.push_back({input.numbers[member.flight], member.object});
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
  map.frame.emplace(fleet.begin()->second.origin);
  map.home_height_msl_m = home_of(fleet);
  Input input = prepare(fleet, config, map);

  std::vector<Members> objects = associate(input, config);
  MapEstimate estimate = solve_map(input.models, objects);
  merge_all(input, config, objects, estimate);
  std::vector<CommonError> errors = common_errors(input.models, objects, estimate);
  while (const auto worst = worst_flight(errors, config.quarantine_gate)) {
    quarantine(*worst, errors[*worst], input, objects, map);
    estimate = solve_map(input.models, objects);
    errors = common_errors(input.models, objects, estimate);
  }
  for (std::size_t i = 0; i < input.size(); ++i) judge(errors[i], config, map.flights[input.numbers[i]]);
  for (std::size_t i = 0; i < objects.size(); ++i)
    map.objects.push_back(fused_object(i + 1, objects[i], estimate.objects[i], input));
  return map;
}

}  // namespace geoloc
