// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/projection/ground_fix.hpp"
#include "geoloc/projection/height_grid.hpp"
#include "geoloc/state/vehicle_state.hpp"
#include "geoloc/tracking/joint_tracker_config.hpp"
#include "geoloc/tracking/known_points.hpp"
#include "geoloc/tracking/paper_tracker_config.hpp"

namespace geoloc {

/// How objects are estimated from the fixes.
enum class Method {
  kPaper,  ///< one Kalman filter per object, every error taken as noise (PaperTracker)
  kJoint   ///< objects, the camera's calibration and the vehicle's drift together (JointTracker)
};

/// Everything a Geolocator can be told: the settings of each of its stages.
struct GeolocatorConfig {
  Method method = Method::kJoint;
  CameraOrientation camera_orientation = CameraOrientation::kComposed;
  int max_detections = 256;     ///< per frame; of more, the most confident are used
  double edge_margin_px = 2.0;  ///< boxes nearer to the image's edge are not used; 0 uses all
  CameraConfig camera;
  StateConfig state;
  ProjectorConfig projector;
  PaperTrackerConfig paper;
  JointTrackerConfig joint;
  std::vector<KnownPoint> known_points;  ///< of Method::kJoint
  /// Heights of the ground, all of which may be off by the same; nullptr: it is level. It is no setting, and
  /// in no configuration file.
  std::shared_ptr<const HeightGrid> terrain;

  /// Every fault at once, named by its path; empty where a Geolocator can be built.
  std::vector<std::string> problems() const;
};

}  // namespace geoloc
