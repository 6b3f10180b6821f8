// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "import/video_looks.hpp"

namespace geoloc::apps {

/// What a log, or the video itself, tells of the camera.
struct ToldCamera {
  std::optional<double> focal_35mm_mm;       ///< its equivalent for film of 35 mm
  std::optional<double> horizontal_fov_deg;  ///< nominal; goes before the other
  bool is_on_gimbal = false;                 ///< whose angles are told
};

/// The camera of `camera_file` or, where none is named, as it is told; what that leaves open is added to
/// `assumptions`. Throws std::runtime_error where nothing tells, or the file is of another size.
CameraConfig video_camera(const std::string& camera_file, const VideoFacts& video, const ToldCamera& told,
                          std::vector<std::string>& assumptions);

}  // namespace geoloc::apps
