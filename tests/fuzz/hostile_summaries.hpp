// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "fuzz/require.hpp"
#include "geoloc/fleet/fusion.hpp"
#include "geoloc/io/fleet/summary_file.hpp"

namespace geoloc::io::hostile {

inline bool is_usable(const FusedMap& map) {
  for (const FusedObject& object : map.objects) {
    if (!object.position_in_enu.allFinite() || !object.covariance.allFinite() || object.contributions.empty())
      return false;
  }
  for (const FusedFlight& flight : map.flights) {
    if (!flight.common_error_m.allFinite() || !flight.sigma_m.allFinite() || !std::isfinite(flight.chi2))
      return false;
  }
  return true;
}

/// What is read can be written in either form, is read again the same, and can be fused.
inline void use(const FlightSummary& summary) {
  require(summary.problems().empty());
  const std::string bytes = summary_to_bytes(summary);
  require(summary_to_bytes(summary_from_bytes(bytes, "again")) == bytes);
  require(summary_to_bytes(summary_from_json(summary_to_json(summary), "again")) == bytes);
  constexpr std::size_t kMostToFuse = 64;
  if (summary.objects.size() > kMostToFuse || summary.shared_count() > 16) return;
  Fleet fleet;
  FlightSummary other = summary;
  other.identity.flight = "other";
  take(summary, fleet);
  take(other, fleet);
  if (summary.part) {  // the rest of the flight, as the same summary would have it
    other.identity.flight = "rest";
    const Duration length = other.part->run.ended_at - other.part->state.first_node_at;
    for (VehicleTime* const time :
         {&other.part->run.ended_at, &other.part->state.first_node_at, &other.part->state.last_node_at})
      *time += length;
    take(other, fleet);
  }
  require(is_usable(fuse(fleet)));
}

inline void read_any_summary(const std::string& content) {
  try {
    use(parse_summary(content, "any"));
  } catch (const std::runtime_error&) {
  }
}

/// The same with the right checksum, so that what is behind it is reached.
inline void read_any_sealed_summary(std::string content) {
  const std::uint64_t sum = summary_checksum(content);
  content.append(reinterpret_cast<const char*>(&sum), sizeof(sum));
  read_any_summary(content);
}

}  // namespace geoloc::io::hostile
