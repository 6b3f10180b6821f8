// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "import/video_looks.hpp"

namespace geoloc::apps {

/// A video's camera, and how well its focal length is known.
struct VideoCamera {
  CameraConfig config;
  double sigma_focal_percent = 0.0;  ///< 1-sigma; 0: it is a calibration's
};

/// The camera of `camera_file` or, where none is named, what the log tells of its lens; what that leaves open
/// is added to `assumptions`. Throws std::runtime_error where nothing tells, or the file is of another size.
VideoCamera video_camera(const std::string& camera_file, const VideoFacts& video,
                         std::optional<double> focal_35mm_mm, std::vector<std::string>& assumptions);

}  // namespace geoloc::apps
