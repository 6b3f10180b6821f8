// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "geoloc/camera/camera.hpp"

namespace geoloc::io {

/// Reads camera.json, or the YAML that OpenCV's calibration and ROS' camera_info write (which have no mount:
/// it stays as in `defaults`). Throws std::runtime_error naming the file and every fault.
CameraConfig read_camera_file(const std::filesystem::path& file, const CameraConfig& defaults = {});

/// The YAML alone; `name` stands for the file in messages.
CameraConfig camera_from_yaml(const std::string& text, const std::string& name, const CameraConfig& defaults);

}  // namespace geoloc::io
