// SPDX-License-Identifier: Apache-2.0
#include "fleet/flight_parts.hpp"

#include <algorithm>
#include <string>
#include <tuple>

namespace geoloc {
namespace {

using Flight = std::vector<std::size_t>;  // places of its parts

/// What the times of a boot may differ by that two runs tell: their clocks are compared with some noise.
constexpr Duration kBootTolerance = std::chrono::seconds{3};
/// By the same, parts that follow each other may seem to overlap.
constexpr Duration kOverlapTolerance = std::chrono::milliseconds{500};

HostTime began_at(const FlightSummary& summary) {
  return host_time(summary.part->run, summary.part->state.first_node_at);
}
HostTime ended_at(const FlightSummary& summary) {
  return host_time(summary.part->run, summary.part->run.ended_at);
}

/// By what flights are told apart, and then the order of boots.
auto key_of(const FlightSummary& summary) {
  const FlightRun& run = summary.part->run;
  const std::string vehicle = run.whole.empty() ? summary.identity.vehicle : "";
  return std::tuple(run.whole, vehicle, run.booted_at, summary.identity.flight);
}

bool may_be_one_flight(const FlightSummary& a, const FlightSummary& b) {
  const FlightRun &one = a.part->run, &other = b.part->run;
  if (one.whole != other.whole) return false;
  if (!one.whole.empty()) return true;
  return a.identity.vehicle == b.identity.vehicle && other.booted_at - one.booted_at <= kBootTolerance;
}

/// The parts that follow each other are one flight; each of the others is one by itself.
void add_in_time(const std::vector<FlightSummary>& summaries, Flight parts, std::vector<Flight>& flights) {
  std::sort(parts.begin(), parts.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(began_at(summaries[a]), a) < std::tuple(began_at(summaries[b]), b);
  });
  Flight flight;
  for (const std::size_t part : parts) {
    if (flight.empty() ||
        began_at(summaries[part]) >= ended_at(summaries[flight.back()]) - kOverlapTolerance) {
      flight.push_back(part);
    } else {
      flights.push_back({part});
    }
  }
  if (!flight.empty()) flights.push_back(std::move(flight));
}

}  // namespace

std::vector<std::vector<std::size_t>> flights_of_parts(const std::vector<FlightSummary>& summaries) {
  std::vector<Flight> flights;
  Flight parts;
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    if (summaries[i].part) {
      parts.push_back(i);
    } else {
      flights.push_back({i});
    }
  }
  std::sort(parts.begin(), parts.end(),
            [&](std::size_t a, std::size_t b) { return key_of(summaries[a]) < key_of(summaries[b]); });
  for (auto begin = parts.begin(); begin != parts.end();) {
    const auto end = std::find_if(begin, parts.end(), [&](std::size_t part) {
      return !may_be_one_flight(summaries[*begin], summaries[part]);
    });
    add_in_time(summaries, Flight(begin, end), flights);
    begin = end;
  }
  std::sort(flights.begin(), flights.end(), [](const Flight& a, const Flight& b) {
    return *std::min_element(a.begin(), a.end()) < *std::min_element(b.begin(), b.end());
  });
  return flights;
}

}  // namespace geoloc
