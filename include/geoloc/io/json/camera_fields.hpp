// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "geoloc/camera/camera.hpp"

namespace geoloc::io {

template <class Visitor, class Mount>
void visit_mount(Visitor& v, Mount& mount) {
  v.field("roll_deg", mount.roll_deg, "about the camera carrier's forward axis, applied last");
  v.field("pitch_deg", mount.pitch_deg, "nose up; a camera that looks straight down is -90");
  v.field("yaw_deg", mount.yaw_deg, "clockwise from the nose, applied first");
  v.field("x_m", mount.x_m, "lever arm, forward");
  v.field("y_m", mount.y_m, "lever arm, right");
  v.field("z_m", mount.z_m, "lever arm, down");
}

/// JSON of camera.json (docs/formats.md), pretty-printed.
std::string camera_to_json(const CameraConfig& camera);

/// Reads camera.json, or the `camera_matrix` YAML that OpenCV's calibration and ROS' camera_info write (those hold no
/// mount: it stays as in `defaults`). Throws std::runtime_error naming the file and every fault.
CameraConfig read_camera_file(const std::filesystem::path& file, const CameraConfig& defaults = {});

/// The same for a text that is already in memory; `name` stands for it in messages.
CameraConfig camera_from_json(const std::string& text, const std::string& name, const CameraConfig& defaults = {});
CameraConfig camera_from_yaml(const std::string& text, const std::string& name, const CameraConfig& defaults = {});

}  // namespace geoloc::io
