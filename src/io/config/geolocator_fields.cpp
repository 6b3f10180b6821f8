// SPDX-License-Identifier: Apache-2.0
#include "pipeline/geolocator_fields.hpp"

#include <stdexcept>

#include "geoloc/io/config/geolocator_fields.hpp"
#include "geoloc/io/json/camera_fields.hpp"
#include "geoloc/io/json/camera_file.hpp"
#include "io/config/settings_json.hpp"
#include "io/json/field_writer.hpp"

namespace geoloc::io {

void take_camera(nlohmann::json& document, CameraConfig& camera, std::vector<std::string>& problems) {
  if (!document.is_object() || !document.contains("camera")) return;
  const nlohmann::json value = document["camera"];
  document.erase("camera");
  if (!value.is_string()) return camera_from_json(value, "camera", true, camera, problems);
  try {
    camera = read_camera_file(value.get<std::string>(), camera);
  } catch (const std::runtime_error& error) {
    problems.push_back(std::string("camera: ") + error.what());
  }
}

nlohmann::ordered_json geolocator_to_json(const GeolocatorConfig& config) {
  return fields_to_json(config);
}

void geolocator_from_json(const nlohmann::json& object, GeolocatorConfig& config,
                          std::vector<std::string>& problems) {
  settings_from_json(object, {}, config.camera, config, problems);
}

}  // namespace geoloc::io
