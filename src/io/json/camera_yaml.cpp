// SPDX-License-Identifier: Apache-2.0
#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <string>
#include <vector>

#include "geoloc/io/json/camera_file.hpp"
#include "io/json/camera_fault.hpp"

namespace geoloc::io {
namespace {

/// Removes the directive `%YAML:1.0`, which OpenCV writes but is not YAML; the rest of the file is.
std::string without_opencv_directive(const std::string& text) {
  if (text.rfind("%YAML:", 0) != 0) return text;
  const std::size_t end = text.find('\n');
  return end == std::string::npos ? std::string() : text.substr(end + 1);
}

std::vector<double> matrix_data(const YAML::Node& root, const std::string& key, std::size_t at_least,
                                std::size_t at_most, std::vector<std::string>& problems) {
  std::vector<double> values;
  const YAML::Node data = root[key] ? root[key]["data"] : YAML::Node();
  if (!data || !data.IsSequence() || data.size() < at_least || data.size() > at_most) {
    problems.push_back(key + ".data must list " + std::to_string(at_least) +
                       (at_most > at_least ? " to " + std::to_string(at_most) : "") + " numbers");
    return values;
  }
  for (const auto& value : data) values.push_back(value.as<double>());
  return values;
}

void read_yaml(const YAML::Node& root, CameraConfig& camera, std::vector<std::string>& problems) {
  camera.intrinsics.width_px = root["image_width"].as<int>();
  camera.intrinsics.height_px = root["image_height"].as<int>();
  const auto model = root["distortion_model"] ? root["distortion_model"].as<std::string>() : "plumb_bob";
  if (model != "plumb_bob") {
    problems.push_back("distortion_model " + model +
                       " is not supported: calibrate with plumb_bob (k1 k2 p1 p2 k3)");
  }
  const auto k = matrix_data(root, "camera_matrix", 9, 9, problems);
  const auto d = matrix_data(root, "distortion_coefficients", 4, 5, problems);
  if (!problems.empty()) return;
  camera.intrinsics.fx_px = k[0];
  camera.intrinsics.cx_px = k[2];
  camera.intrinsics.fy_px = k[4];
  camera.intrinsics.cy_px = k[5];
  camera.intrinsics.distortion.fill(0.0);
  for (std::size_t i = 0; i < d.size(); ++i) camera.intrinsics.distortion[i] = d[i];
}

}  // namespace

CameraConfig camera_from_yaml(const std::string& text, const std::string& name,
                              const CameraConfig& defaults) {
  CameraConfig camera = defaults;
  std::vector<std::string> problems;
  try {
    const YAML::Node root = YAML::Load(without_opencv_directive(text));
    if (!root.IsMap() || !root["image_width"] || !root["image_height"] || !root["camera_matrix"]) {
      refuse_camera(
          name,
          {"image_width, image_height and camera_matrix are needed (OpenCV's or ROS' calibration YAML)"});
    }
    read_yaml(root, camera, problems);
  } catch (const YAML::Exception& error) {
    refuse_camera(name, {error.what()});
  }
  if (problems.empty()) problems = camera.problems();
  if (!problems.empty()) refuse_camera(name, problems);
  return camera;
}

}  // namespace geoloc::io
