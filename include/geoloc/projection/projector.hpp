// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/geometry/expected.hpp"
#include "geoloc/geometry/ray_plane.hpp"
#include "geoloc/geometry/rigid3.hpp"
#include "geoloc/projection/ground_fix.hpp"
#include "geoloc/projection/ground_model.hpp"

namespace geoloc {

/// Pixel to ground point on a horizontal plane, and back (paper, eq. 7-10); or on ground that rises and falls
/// about that plane.
class Projector {
 public:
  /// Throws std::invalid_argument naming every problem.
  Projector(const ProjectorConfig& config, const CameraIntrinsics& intrinsics);

  /// `enu_from_camera`: pose at the capture time, up measured from home.
  Expected<GroundFix, NoFix> project(const Eigen::Vector2d& pixel, const Rigid3d& enu_from_camera) const;

  /// On the ground, whose heights count from the plane.
  Expected<GroundFix, NoFix> project(const Eigen::Vector2d& pixel, const Rigid3d& enu_from_camera,
                                     const GroundModel& ground) const;

  /// The fix of a point that need not lie in the plane: as if the ground were level at its height. NoFix
  /// where project() has none for its pixel.
  Expected<GroundFix, NoFix> fix_of_point(const Eigen::Vector3d& point_in_enu,
                                          const Rigid3d& enu_from_camera) const;

  /// All pixels of one frame; fixes[i] belongs to pixels[i]. `fixes` is overwritten, within its capacity.
  void project(const std::vector<Eigen::Vector2d>& pixels, const Rigid3d& enu_from_camera,
               std::vector<Expected<GroundFix, NoFix>>& fixes) const;

  /// Pixel of a point, by default of the ground; nullopt behind the camera or beyond its lens model. It may
  /// lie outside the image.
  std::optional<Eigen::Vector2d> reproject(const Eigen::Vector3d& position_in_enu,
                                           const Rigid3d& enu_from_camera) const;
  std::optional<Eigen::Vector2d> reproject(const Eigen::Vector2d& position_in_enu,
                                           const Rigid3d& enu_from_camera) const;

  /// In the image, at least margin_px from its edge, and where project() would answer.
  bool sees(const Eigen::Vector2d& position_in_enu, const Rigid3d& enu_from_camera, double margin_px) const;

  /// The same of a point anywhere.
  bool sees_point(const Eigen::Vector3d& position_in_enu, const Rigid3d& enu_from_camera,
                  double margin_px) const;

  /// The same of a place on the ground.
  bool sees(const Eigen::Vector2d& position_in_enu, const Rigid3d& enu_from_camera, double margin_px,
            const GroundModel& ground) const;

  const CameraModel& camera() const { return camera_; }
  const ProjectorConfig& config() const { return config_; }

 private:
  struct PixelRay;
  Expected<PixelRay, NoFix> ray_of(const Eigen::Vector2d& pixel, const Rigid3d& enu_from_camera) const;
  Expected<double, NoFix> range_of_plane(const Ray<double>& ray) const;

  ProjectorConfig config_;
  CameraModel camera_;
  double min_depression_sine_;
};

}  // namespace geoloc
