// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "geoloc/calibration/landmark.hpp"
#include "geoloc/camera/detection.hpp"
#include "geoloc/tracking/joint_association.hpp"

namespace geoloc {

/// A detection of the present frame, with all that a track needs of it.
struct Look {
  LandmarkObservation observation;
  Eigen::Vector2d position;  ///< corrected by calibration and drift [m]
  Eigen::Matrix2d pixel_noise;
  Eigen::Matrix2d frame_noise;   ///< of attitude and position, shared by the looks of a frame
  SharedError::Row jacobian;     ///< of the position, whitened
  double clutter_density = 0.0;  ///< [1/m^2]
  double ground_per_pixel_m = 0.0;
  double size_m = 0.0;
  const Detection* detection = nullptr;
};

}  // namespace geoloc
