// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/stop_signal.hpp"
#include "geoloc/io/stills/still.hpp"

namespace geoloc::apps {

/// A picture and what it tells of itself.
struct NamedStill {
  std::filesystem::path file;
  io::Still still;
};

/// What was read, and for people why the others were not.
struct ReadStills {
  std::vector<NamedStill> stills;
  std::vector<std::string> left_out;  ///< file and reason
};

/// Reads the metadata of each file, until `stop`.
ReadStills read_stills(const std::vector<std::filesystem::path>& files, const StopSignal& stop);

}  // namespace geoloc::apps
