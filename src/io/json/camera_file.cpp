// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/json/camera_file.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "geoloc/io/json/camera_fields.hpp"
#include "geoloc/io/text_file.hpp"
#include "io/json/camera_fault.hpp"

namespace geoloc::io {

CameraConfig read_camera_file(const std::filesystem::path& file, const CameraConfig& defaults) {
  const std::string text = read_text_file(file);
  const std::string extension = file.extension().string();
  if (extension == ".yaml" || extension == ".yml") return camera_from_yaml(text, file.string(), defaults);

  CameraConfig camera = defaults;
  std::vector<std::string> problems;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded())
    refuse_camera(file.string(), {"not JSON (a calibration in YAML must end in .yaml or .yml)"});
  for (const char* key : {"width", "height"}) {
    if (!json.contains(key)) problems.push_back(std::string(key) + " is missing");
  }
  if (!json.contains("horizontal_fov_deg")) {
    for (const char* key : {"fx", "fy", "cx", "cy"}) {
      if (!json.contains(key))
        problems.push_back(std::string(key) + " is missing (or give horizontal_fov_deg)");
    }
  }
  camera_from_json(json, "", false, camera, problems);
  if (problems.empty()) problems = camera.problems();
  if (!problems.empty()) refuse_camera(file.string(), problems);
  return camera;
}

}  // namespace geoloc::io
