// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/landmark.hpp"
#include "calibration/shared_error.hpp"
#include "geoloc/camera/detection.hpp"

namespace geoloc {

/// A detection of the present frame, with all that a track needs of it.
struct Look {
  Detection detection;
  LandmarkObservation observation;
  Eigen::Vector2d position;     ///< east, north [m], corrected by calibration and drift
  Eigen::Matrix2d pixel_noise;  ///< covariance that the detector's noise causes on the ground [m^2]
  Eigen::Matrix2d frame_noise;  ///< covariance of attitude and position, shared by the looks of a frame [m^2]
  SharedError::Row jacobian;    ///< d position / d shared error, whitened [m]
  double clutter_density = 0.0;  ///< false boxes per frame and area [1/m^2]
  double ground_per_pixel_m = 0.0;
  double size_m = 0.0;
};

/// All looks of a frame.
struct FrameLooks {
  std::vector<Look> at_rest;
  std::vector<Look> moving;                               ///< at objects of classes that may move
  Eigen::Matrix2d frame_noise = Eigen::Matrix2d::Zero();  ///< mean of the looks' [m^2]
};

}  // namespace geoloc
