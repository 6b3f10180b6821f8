// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/output_files.hpp"
#include "geoloc/io/live_page/live_page_config.hpp"
#include "geoloc/io/mavlink/mavlink_config.hpp"
#include "geoloc/io/output/cot_config.hpp"
#include "geoloc/pipeline/geolocator_config.hpp"

namespace geoloc::apps {

struct FrameConfig {
  double max_wait_s = 4.0;  ///< for the vehicle's state around a frame
};

/// What a live run and a replay have in common.
struct EstimationConfig {
  GeolocatorConfig geolocator;
  io::MavlinkConfig mavlink;
  FrameConfig frames;
  io::LivePageConfig live_page;
  io::CotConfig cot;
};

/// Every setting with its present value; estimation_from_json() accepts it back.
nlohmann::ordered_json estimation_to_json(const EstimationConfig& config);

/// Reads over `config`. `ignored_sections`: top-level keys that belong to other programs.
void estimation_from_json(const nlohmann::json& document, const std::vector<std::string>& ignored_sections,
                          EstimationConfig& config, std::vector<std::string>& problems);

/// The JSON document in a configuration file. Throws std::runtime_error naming the file and the place of the
/// fault.
nlohmann::json read_config_document(const std::string& file);

/// A configuration file, if one is given, and the calibration, keys and certificates that it names, as inputs
/// for check_outputs().
NamedFiles files_of_config(const std::string& file);

/// Throws std::runtime_error that lists all problems of `file` unless there are none.
void refuse_problems(const std::string& file, const std::vector<std::string>& problems);

}  // namespace geoloc::apps
