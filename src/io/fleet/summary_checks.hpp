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

/// Summaries of a flight that has no other parts are as they were before there were parts.
inline constexpr std::uint32_t kPlainVersion = 1;

inline std::uint32_t version_of(const FlightSummary& summary) {
  return summary.part ? kSummaryVersion : kPlainVersion;
}

inline void refuse_other_version(const std::string& name, std::uint64_t version) {
  if (version == kPlainVersion || version == kSummaryVersion) return;
  refuse_summary(name,
                 "is a flight summary of format version " + std::to_string(version) +
                     "; this program reads versions " + std::to_string(kPlainVersion) + " and " +
                     std::to_string(kSummaryVersion) +
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

/// The same of what a part of a flight tells.
inline void refuse_absurd_part(const std::string& name, std::size_t unknowns, std::size_t shared) {
  constexpr auto kMostErrors = static_cast<std::size_t>(FlightSummary::kMostShared) + kFlightUnknowns;
  if (unknowns > kFlightUnknowns)
    refuse_summary(name, "tells of " + std::to_string(unknowns) + " unknowns of its flight; there are " +
                             std::to_string(kFlightUnknowns));
  if (shared > kMostErrors)
    refuse_summary(name, "tells of " + std::to_string(shared) + " errors of its flight's unknowns; at most " +
                             std::to_string(kMostErrors) + " are read");
}

inline void refuse_problems(const std::string& name, const FlightSummary& summary) {
  std::string all;
  for (const std::string& problem : summary.problems()) all += (all.empty() ? "" : "; ") + problem;
  if (!all.empty()) refuse_summary(name, all);
}

}  // namespace geoloc::io
