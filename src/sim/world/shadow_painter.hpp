// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "geoloc/camera/camera.hpp"
#include "geoloc/geometry/rigid3.hpp"
#include "geoloc/sim/world/scene.hpp"

namespace geoloc::sim {

/// Darkens what lies in the shadow. image: CV_8UC3 of the camera's size. Nothing is done where a part of the
/// outline has no image.
void cast_shadow(const CameraModel& camera, const Rigid3d& enu_from_camera, const Shadow& shadow,
                 cv::Mat& image);

}  // namespace geoloc::sim
