// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

#include "calibration/landmark.hpp"
#include "calibration/shared_error.hpp"
#include "geoloc/camera/detection.hpp"
#include "geoloc/projection/ground_fix.hpp"

namespace geoloc {

/// A detection of the present frame, with all that a track needs of it.
struct Look {
  Detection detection;
  GroundFix fix;
  LandmarkObservation observation;
  /// East, north [m] where its ray is at the height of the ground below the vehicle (terrain_m), corrected by
  /// calibration and drift.
  Eigen::Vector2d position;
  Eigen::Matrix2d pixel_noise;  ///< covariance that the detector's noise causes on the ground [m^2]
  Eigen::Matrix2d frame_noise;  ///< covariance of attitude and position, shared by the looks of a frame [m^2]
  SharedError::Row jacobian;    ///< d position / d shared error, whitened [m]

  /// The slope of the ray that meets a place at the height of `position`.
  Eigen::Vector2d slope_at(const Eigen::Vector2d& place) const {
    return observation.slope + (position - place) / camera_height_m;
  }

  /// Where the look's frame shows a point of that height: what is to be compared with `position`.
  Eigen::Vector2d shown(const Point& point_in_enu) const {
    const double up_m = point_in_enu.z() - terrain_m;
    const double nearer = std::max(0.1, 1.0 - up_m / camera_height_m);
    const Eigen::Vector2d place = point_in_enu.head<2>();
    return place - slope_at(place) * up_m / nearer;
  }

  double terrain_m = 0.0;  ///< height of `position` above the level ground
  double camera_height_m = std::numeric_limits<double>::infinity();  ///< above `position`
  double one_per_image = 0.0;    ///< density of one point in an image, on the ground there [1/m^2]
  double clutter_density = 0.0;  ///< false boxes of such a confidence per frame and area [1/m^2], by objects'
  double confidence_ratio = 1.0;  ///< how much more often objects have it than false boxes do
  double ground_per_pixel_m = 0.0;
  double size_m = 0.0;
};

/// All looks of a frame.
struct FrameLooks {
  std::vector<Look> at_rest;
  double share_attitude = 0.0;  ///< how many detections at rest share the noise of the attitude
  std::vector<Look> moving;     ///< at objects of classes that may move
  Eigen::Matrix2d frame_noise = Eigen::Matrix2d::Zero();  ///< mean of the looks' [m^2]
};

}  // namespace geoloc
