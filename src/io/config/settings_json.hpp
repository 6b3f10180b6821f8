// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "io/json/field_reader.hpp"
#include "settings/field_checker.hpp"

namespace geoloc::io {

/// Takes `camera` out of a document: an object (camera.json's), or the name of a calibration file.
void take_camera(nlohmann::json& document, CameraConfig& camera, std::vector<std::string>& problems);

/// Reads a document over a structure that visit_fields() describes and that holds `camera`. Adds every
/// problem, those of the values that stay included. `ignored`: keys that belong to other programs.
template <typename Config>
void settings_from_json(nlohmann::json document, const std::vector<std::string>& ignored,
                        CameraConfig& camera, Config& config, std::vector<std::string>& problems) {
  take_camera(document, camera, problems);
  FieldReader reader(document, "", problems);
  visit_fields(reader, config);
  for (const std::string& key : ignored) reader.ignore(key);
  reader.refuse_unknown();
  FieldChecker checker(problems);
  visit_fields(checker, config);
}

}  // namespace geoloc::io
