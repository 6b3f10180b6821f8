// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/fleet/flight_summary.hpp"

namespace geoloc {

/// The latest summary of each flight, by its id.
using Fleet = std::map<std::string, FlightSummary>;

/// Takes the summary unless the fleet has one of that flight with the same sequence number, or a higher one.
/// The order of calls, and how often one is repeated, make no difference. Whether it was taken.
bool take(FlightSummary summary, Fleet& fleet);

/// Settings of fuse(). Sigmas are 1-sigma.
struct FusionConfig {
  double sigma_home_m = 3.0;      ///< of the height that a flight's home is said to have: barometers drift
  double sigma_no_home_m = 30.0;  ///< of that of flights that say none
  double sigma_object_m =
      0.15;                    ///< horizontal, of an object seen from different directions: association only
  double gate = 13.8;          ///< chi-square, 2 degrees of freedom: association
  double most_shift_m = 15.0;  ///< that flights may be off against each other, whatever they say
  /// Chi-square, 2 degrees of freedom, of a flight's common shift against all others, from which on it is
  /// quarantined. Honest flights reach half of that once in a hundred.
  double quarantine_gate = 20.0;
  double reach_m = 50e3;  ///< of the fleet's frame: flights that began farther from the first are left out
  /// Shared errors of all flights together that are estimated; beyond, the least of each flight are taken as
  /// noise of its objects.
  int most_unknowns = 3000;

  std::vector<std::string> problems() const;
};

/// An object of one flight.
struct Contribution {
  std::size_t flight = 0;  ///< place among FusedMap::flights
  std::size_t object = 0;  ///< place among its summary's objects
};

/// An object of the fleet's map.
struct FusedObject {
  std::uint64_t id = 0;  ///< in the map; from 1
  Eigen::Vector3d position_in_enu =
      Eigen::Vector3d::Zero();  ///< east, north, up above the first flight's home
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< of the absolute position [m^2]
  int hits = 0;
  double existence = 0.0;
  ClassVotes class_votes;
  HostTime first_seen;
  HostTime last_seen;
  std::vector<Contribution> contributions;  ///< in order of the flights
};

enum class FlightVerdict {
  kFused,
  kAlone,        ///< it shares no object with another: nothing checks it
  kDisputed,     ///< it disagrees with the only flight that shares objects with it: one of the two is wrong
  kQuarantined,  ///< it disagrees with the others: its objects are not in the map
  kTooFar        ///< it began beyond the reach of the fleet's frame
};

/// What became of a flight.
struct FusedFlight {
  FlightIdentity identity;
  FlightVerdict verdict = FlightVerdict::kAlone;
  std::string reason;  ///< of all but kFused, and of a flight that contradicts its other parts; for people
  /// Places of the flights that are parts of one with it, itself included; empty: it is one by itself.
  std::vector<std::size_t> parts;
  /// By how much its objects are off in common [m]: reported minus estimated, east, north, up.
  Eigen::Vector3d common_error_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Zero();  ///< of that
  double chi2 = 0.0;  ///< of its common shift against all others, 2 degrees of freedom
  std::size_t objects = 0;
  std::size_t shared_objects = 0;  ///< that other flights have, too
};

struct FusedMap {
  std::optional<LocalFrame> frame;          ///< nullopt: there is no flight
  std::optional<double> home_height_msl_m;  ///< that heights count from
  std::vector<FusedObject> objects;         ///< in order of their ids
  std::vector<FusedFlight> flights;         ///< in order of the flights' ids
};

/// One map of all flights: which objects are the same, where they are, and what each flight was off by. Every
/// flight's receiver is off by another offset, which no flight can see by itself, and which the others show:
/// what flights have in common is estimated with the objects (docs/fleet.md). The same fleet gives the same
/// map. `fleet`: summaries without problems(). Throws std::invalid_argument naming every problem of the
/// configuration.
FusedMap fuse(const Fleet& fleet, const FusionConfig& config = {});

}  // namespace geoloc
