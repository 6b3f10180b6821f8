// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibration/landmark.hpp"
#include "geoloc/projection/ground_fix.hpp"

namespace geoloc {

/// How a fix moves on the ground when calibration and drift change.
struct FixJacobians {
  Eigen::Matrix<double, 2, CalibrationIndex::kSize> calibration;  ///< see CalibrationIndex
  Eigen::Matrix<double, 2, kNodeSize> node;                       ///< east, north, up, yaw
  Eigen::Vector2d height;  ///< by the height of the camera, or the depth of the ground
};

/// Analytic, at the fix and the view it was located with.
FixJacobians jacobians_of(const GroundFix& fix, const FrameView& view, double height_above_ground_m);

}  // namespace geoloc
