// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/json/camera_file.hpp"

#include <yaml-cpp/yaml.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "geoloc/io/json/camera_fields.hpp"

namespace geoloc::io {
namespace {

[[noreturn]] void fail(const std::string& name, const std::vector<std::string>& problems) {
  std::string all;
  for (const std::string& problem : problems) all += "\n  " + problem;
  throw std::runtime_error(name + ": not a usable camera calibration:" + all);
}

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

std::string read_text_file(const std::filesystem::path& file, std::size_t max_bytes) {
  std::ifstream input(file, std::ios::binary);
  if (!input || std::filesystem::is_directory(file))
    throw std::runtime_error(file.string() + ": cannot be opened");
  std::string text;
  std::vector<char> chunk(64u << 10);
  while (input.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || input.gcount() > 0) {
    text.append(chunk.data(), static_cast<std::size_t>(input.gcount()));
    if (text.size() > max_bytes) {
      throw std::runtime_error(file.string() + ": larger than " + std::to_string(max_bytes) + " bytes");
    }
  }
  if (input.bad()) throw std::runtime_error(file.string() + ": cannot be read");
  return text;
}

CameraConfig camera_from_yaml(const std::string& text, const std::string& name,
                              const CameraConfig& defaults) {
  CameraConfig camera = defaults;
  std::vector<std::string> problems;
  try {
    const YAML::Node root = YAML::Load(without_opencv_directive(text));
    if (!root.IsMap() || !root["image_width"] || !root["image_height"] || !root["camera_matrix"]) {
      fail(name,
           {"image_width, image_height and camera_matrix are needed (OpenCV's or ROS' calibration YAML)"});
    }
    read_yaml(root, camera, problems);
  } catch (const YAML::Exception& error) {
    fail(name, {error.what()});
  }
  if (problems.empty()) problems = camera.problems();
  if (!problems.empty()) fail(name, problems);
  return camera;
}

CameraConfig read_camera_file(const std::filesystem::path& file, const CameraConfig& defaults) {
  const std::string text = read_text_file(file);
  const std::string extension = file.extension().string();
  if (extension == ".yaml" || extension == ".yml") return camera_from_yaml(text, file.string(), defaults);

  CameraConfig camera = defaults;
  std::vector<std::string> problems;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded())
    fail(file.string(), {"not JSON (a calibration in YAML must end in .yaml or .yml)"});
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
  if (!problems.empty()) fail(file.string(), problems);
  return camera;
}

}  // namespace geoloc::io
