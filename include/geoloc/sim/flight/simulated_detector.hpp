// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/rigid3.hpp"
#include "geoloc/sim/random.hpp"

namespace geoloc::sim {

/// A detector as its errors.
struct DetectorModel {
  double target_size_m = 0.8;   ///< [m] diameter of a target on the ground
  double pixel_noise_px = 1.5;  ///< [px] 1-sigma of a box's centre in x and in y
  double miss_rate = 0.05;      ///< share of the visible targets that are not found
  double clutter_rate = 0.03;   ///< mean number of boxes where nothing is, a frame; 2.3: two or three
  std::array<double, 2> confidence{0.5, 0.95};          ///< of targets: the least and the most
  std::array<double, 2> clutter_confidence{0.5, 0.95};  ///< of boxes where nothing is
  double min_visible_fraction = 1.0;  ///< of a target's box within the image; below it is not found

  /// Every fault, named by its JSON path.
  std::vector<std::string> problems() const;
};

/// Box around the image of a level disc, cut at the image's edges; nullopt where less than
/// min_visible_fraction of it lies within the image, or any of it behind the camera.
std::optional<Box> disc_in_image(const CameraModel& camera, const Rigid3d& camera_from_enu,
                                 const Eigen::Vector3d& centre_in_enu, const DetectorModel& model);

/// Draws what a detector would report, frame by frame.
class SimulatedDetector {
 public:
  /// Throws std::invalid_argument naming every problem.
  SimulatedDetector(const DetectorModel& model, const CameraIntrinsics& intrinsics,
                    std::vector<Eigen::Vector3d> targets_in_enu, std::uint64_t seed);

  /// Detections of one frame, the most confident first. `zoom`: by which the focal length is longer.
  std::vector<Detection> detect(const Rigid3d& enu_from_camera, double zoom = 1.0);

 private:
  int draw_clutter_count();
  Detection draw_clutter();

  DetectorModel model_;
  CameraModel camera_;
  std::vector<Eigen::Vector3d> targets_in_enu_;
  Random detections_;
  Random clutter_;
};

}  // namespace geoloc::sim
