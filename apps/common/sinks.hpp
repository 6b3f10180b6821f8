// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/outputs.hpp"

namespace geoloc::apps {

/// The outputs that a command line names; empty ones are left out.
struct OutputFiles {
  std::string objects;             ///< GeoJSON
  std::string raw;                 ///< CSV of every located detection
  std::string picture;             ///< SVG
  std::string http;                ///< [HOST:]PORT of the live page
  std::string csv;                 ///< of the objects
  std::string kml;                 ///< of the run
  std::vector<std::string> jsonl;  ///< files, or "-" for standard output
  std::vector<std::string> cot;    ///< endpoints: udp://HOST:PORT, tcp://HOST:PORT

  /// Whether standard output is taken, or a file holds what is otherwise printed there.
  bool has_objects() const;
};

/// Throws std::invalid_argument for what is none.
void add_sinks(const OutputFiles& files, const EstimationConfig& config, Outputs& outputs);

}  // namespace geoloc::apps
