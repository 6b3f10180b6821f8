// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "geoloc/io/json/camera_file.hpp"
#include "io/json/camera_fault.hpp"

namespace geoloc::io {

CameraConfig camera_from_yaml(const std::string& /*text*/, const std::string& name,
                              const CameraConfig& /*defaults*/) {
  refuse_camera(name, {"it is YAML, and geoloc was built without yaml-cpp"});
}

}  // namespace geoloc::io
