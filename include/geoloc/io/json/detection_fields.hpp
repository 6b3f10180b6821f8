// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "geoloc/camera/detection.hpp"

namespace geoloc::io {

/// The object of frames.jsonl: `box`, `confidence`, `class_id`, and `sigma_px` where it is stated.
nlohmann::ordered_json detection_to_json(const Detection& detection);

/// Reads that object back. Throws std::invalid_argument naming what is missing or impossible.
Detection detection_from_json(const nlohmann::json& value);

}  // namespace geoloc::io
