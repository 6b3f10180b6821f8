// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geoloc/sim/flight/trajectory.hpp"

namespace geoloc::sim {

/// Reads `time_boot_s,lat,lon,alt_amsl,roll,pitch,yaw,…` (degrees and metres; radians; further columns are
/// ignored), one line a sample. Throws std::runtime_error with name, line and reason for anything else.
std::vector<TrueState> parse_truth_csv(std::string_view csv, const std::string& name);

/// The content of a gzip stream. Throws std::runtime_error, naming it, for damage, for a cut end and for more
/// than max_size bytes.
std::string gunzip(std::string_view compressed, const std::string& name, std::size_t max_size = 256U << 20U);

/// Both of them on a file `*.csv.gz`.
std::vector<TrueState> read_truth_file(const std::filesystem::path& file);

}  // namespace geoloc::sim
