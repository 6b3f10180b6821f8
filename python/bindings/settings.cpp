// SPDX-License-Identifier: Apache-2.0
#include "settings.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "geoloc/io/config/geolocator_fields.hpp"
#include "geoloc/io/json/camera_fields.hpp"

namespace geoloc::python {
namespace {

[[noreturn]] void refuse(const std::vector<std::string>& problems) {
  std::string all = "unusable configuration:";
  for (const std::string& problem : problems) all += "\n  " + problem;
  throw std::invalid_argument(all);
}

}  // namespace

GeolocatorConfig config_from(const std::string& settings_json) {
  GeolocatorConfig config;
  std::vector<std::string> problems;
  io::geolocator_from_json(nlohmann::json::parse(settings_json), config, problems);
  if (!problems.empty()) refuse(problems);
  return config;
}

CameraMount mount_from(const std::string& mount_json) {
  CameraMount mount;
  std::vector<std::string> problems;
  io::mount_from_json(nlohmann::json::parse(mount_json), "mount", mount, problems);
  if (!problems.empty()) refuse(problems);
  return mount;
}

}  // namespace geoloc::python
