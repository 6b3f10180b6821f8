// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "import/video_looks.hpp"

namespace geoloc::apps {

/// The camera of `camera_file` or, where none is named, what the log tells of its lens; what that leaves open
/// is added to `assumptions`. Throws std::runtime_error where nothing tells, or the file is of another size.
CameraConfig video_camera(const std::string& camera_file, const VideoFacts& video,
                          std::optional<double> focal_35mm_mm, std::vector<std::string>& assumptions);

}  // namespace geoloc::apps
