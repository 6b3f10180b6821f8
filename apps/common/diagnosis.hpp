// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/run_census.hpp"
#include "common/session.hpp"
#include "geoloc/pipeline/geolocator.hpp"

namespace geoloc::apps {

/// What a run was given, told and got: all that its diagnosis is made from.
struct RunFacts {
  RunCensus census;
  Geolocator::Counters counters;
  GeolocatorConfig config;
  double max_frame_wait_s = 0.0;
  std::string link_fault;  ///< why the telemetry gives no state; empty where it does
  std::uint64_t objects = 0;
  std::uint64_t candidates = 0;  ///< objects that are not confirmed
  double best_existence = 0.0;   ///< of the candidates: the greatest probability of the joint method
  int most_hits = 0;             ///< and the most detections
};

RunFacts facts_of(const Session& session);

/// What is probably wrong with the input, each as a sentence that names the file or the setting that would
/// change it. Empty where nothing is conspicuous.
std::vector<std::string> diagnose(const RunFacts& facts);

}  // namespace geoloc::apps
