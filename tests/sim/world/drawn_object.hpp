// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "geoloc/camera/camera.hpp"
#include "geoloc/geometry/rigid3.hpp"
#include "geoloc/sim/world/scene.hpp"

namespace geoloc::sim {

/// Camera above (0, 0), mounted straight down, in a vehicle of this attitude.
Rigid3d pose_above(double height_m, double roll_deg, double pitch_deg, double yaw_deg);

/// A camera whose lens distorts visibly.
CameraIntrinsics barrel_camera();

/// The contribution of an object to the picture, found without any camera model: grey levels of |with -
/// without| (CV_32FC1).
cv::Mat drawn_object(const CameraIntrinsics& intrinsics, const PlacedObject& object,
                     const Rigid3d& enu_from_camera,
                     const Eigen::Vector2d& blur_px = Eigen::Vector2d::Zero());

/// Centre of mass of a grey image, in the camera's coordinates.
Eigen::Vector2d centre_of_mass(const cv::Mat& grey);

}  // namespace geoloc::sim
