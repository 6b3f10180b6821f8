// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "geoloc/io/output/estimator_report.hpp"
#include "geoloc/io/output/object_report.hpp"

// Parts common to GeoJSON and JSON Lines.
namespace geoloc::io {

/// The properties of docs/formats.md.
nlohmann::ordered_json properties_to_json(const ObjectReport& object);

/// The object as a GeoJSON feature with these properties. It must have a place (has_place()).
nlohmann::ordered_json feature_to_json(const ObjectReport& object);

nlohmann::ordered_json counters_to_json(const RunCounters& counters);

/// null for a method that estimates none.
nlohmann::ordered_json calibration_to_json(const std::optional<Calibration>& calibration);

}  // namespace geoloc::io
