// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "geoloc/fleet/flight_summary.hpp"
#include "geoloc/io/fleet/summary_file.hpp"

// What both forms of a summary are refused for.
namespace geoloc::io {

[[noreturn]] inline void refuse_summary(const std::string& name, const std::string& reason) {
  throw std::runtime_error(name + ": " + reason);
}

inline void refuse_other_version(const std::string& name, std::uint64_t version) {
  if (version == kSummaryVersion) return;
  refuse_summary(name,
                 "is a flight summary of format version " + std::to_string(version) +
                     "; this program reads version " + std::to_string(kSummaryVersion) +
                     ". Replay the recording with --summary, or use the program's release that wrote it");
}

/// Before anything of that size is made room for.
inline void refuse_absurd_sizes(const std::string& name, std::size_t objects, std::size_t shared,
                                std::size_t apart) {
  if (objects > FlightSummary::kMostObjects)
    refuse_summary(name, "tells of " + std::to_string(objects) + " objects; at most " +
                             std::to_string(FlightSummary::kMostObjects) + " are read");
  if (shared > static_cast<std::size_t>(FlightSummary::kMostShared))
    refuse_summary(name, "tells of " + std::to_string(shared) + " shared errors; at most " +
                             std::to_string(FlightSummary::kMostShared) + " are read");
  if (apart > FlightSummary::kMostApart * objects)
    refuse_summary(name, "tells of " + std::to_string(apart) + " pairs apart; at most " +
                             std::to_string(FlightSummary::kMostApart) + " per object are read");
}

inline void refuse_problems(const std::string& name, const FlightSummary& summary) {
  std::string all;
  for (const std::string& problem : summary.problems()) all += (all.empty() ? "" : "; ") + problem;
  if (!all.empty()) refuse_summary(name, all);
}

}  // namespace geoloc::io
