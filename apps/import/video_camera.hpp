// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/io/logs/flight_log.hpp"
#include "import/video_looks.hpp"

namespace geoloc::apps {

/// What a log, or the video itself, tells of the camera.
struct ToldCamera {
  std::vector<io::LoggedFocalLength> focal_lengths;  ///< equivalents for film of 35 mm, in their order
  std::optional<double> horizontal_fov_deg;          ///< nominal; goes before the others
  bool is_on_gimbal = false;                         ///< whose angles are told
};

/// A video's camera, and how well its focal length is known.
struct VideoCamera {
  CameraConfig config;
  double sigma_focal_percent = 0.0;  ///< 1-sigma; 0: it is a calibration's
};

/// The camera of `camera_file` or, where none is named, as it is told; what that leaves open is added to
/// `assumptions`. Throws std::runtime_error where nothing tells, or the file is of another size.
VideoCamera video_camera(const std::string& camera_file, const VideoFacts& video, const ToldCamera& told,
                         std::vector<std::string>& assumptions);

/// The focal length [fx, fy] at a time of the log, by the camera's and by how much longer than the first one
/// the log tells it to be; nullopt where it is the camera's.
std::optional<Eigen::Vector2d> focal_px_at(const std::vector<io::LoggedFocalLength>& told,
                                           const CameraIntrinsics& camera, VehicleTime time);

}  // namespace geoloc::apps
