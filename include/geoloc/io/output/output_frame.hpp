// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/rigid3.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/io/output/camera_sight.hpp"
#include "geoloc/io/output/estimator_report.hpp"
#include "geoloc/io/output/object_report.hpp"
#include "geoloc/io/output/raw_fixes.hpp"

// What the estimator knew after a frame, as plain values that a receiver may keep for as long as it likes.
namespace geoloc::io {

/// A point of the ground plane.
struct GroundPoint {
  Geodetic position;
  Eigen::Vector2d position_in_enu = Eigen::Vector2d::Zero();  ///< [m]
};

/// The viewpoint of a frame.
struct ViewReport {
  Geodetic vehicle;
  Eigen::Vector3d vehicle_in_enu = Eigen::Vector3d::Zero();  ///< [m], up is the height above home
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double yaw_deg = 0.0;     ///< from true north
  Rigid3d enu_from_camera;  ///< calibration applied
  /// The image's corners on the ground, clockwise from the top left; nullopt if one of them does not meet the
  /// ground.
  std::optional<std::array<GroundPoint, 4>> footprint;
  std::optional<GroundPoint> image_centre;
  CameraSight sight;
  Geodetic camera;                ///< calibration applied
  CameraSight camera_in_vehicle;  ///< angles alone: from the nose, about the vehicle's own axes
  HeightReport camera_height;
  HeightReport ground_height;  ///< at the image's centre
};

/// One detection of the frame with its position, before any tracking.
struct FixReport {
  Detection detection;
  GroundPoint ground;
  double range_m = 0.0;  ///< from the camera
  Look look = {};
};

struct OutputFrame {
  HostTime captured_at;
  std::vector<Detection> detections;  ///< all of the frame
  std::optional<ViewReport> view;  ///< nullopt where the vehicle's state was not known: nothing was located
  std::vector<FixReport> fixes;    ///< of the detections that met the ground
  std::vector<ObjectReport> objects;  ///< confirmed, in order of their ids
  std::vector<ObjectReport> tentative;
  EstimatorReport estimator;
  std::uint64_t number = 0;  ///< of the frame in the run, from 0
};

/// Tells what the estimator knew after one frame after another. Of the objects, those are described anew that
/// have changed.
class FrameReporter {
 public:
  explicit FrameReporter(std::vector<std::string> class_names) : class_names_(std::move(class_names)) {}

  /// `is_located` is what Geolocator::process() returned for this frame.
  OutputFrame report(const Geolocator& geolocator, bool is_located, HostTime captured_at,
                     const std::vector<Detection>& detections);

 private:
  std::vector<std::string> class_names_;
  std::vector<ObjectReport> objects_, tentative_;  ///< of the frame before
  Geodetic origin_;                                ///< of their positions
};

}  // namespace geoloc::io
