// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geoloc/pipeline/geolocator_config.hpp"

namespace geoloc::io {

/// The settings of the estimator as JSON, every one with its present value.
nlohmann::ordered_json geolocator_to_json(const GeolocatorConfig& config);

/// Reads that object over `config`. Unknown keys, wrong types and values out of range are added to
/// `problems`, named by their path. `camera` may be an object (camera.json's) or the name of a calibration
/// file.
void geolocator_from_json(const nlohmann::json& object, GeolocatorConfig& config,
                          std::vector<std::string>& problems);

}  // namespace geoloc::io
