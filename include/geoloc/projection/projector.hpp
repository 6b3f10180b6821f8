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
/// about that plane. From a mere pose, the camera has the calibration's focal length.
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

  /// The same from the view of a frame, with the focal length that the camera had then.
  Expected<GroundFix, NoFix> project(const Eigen::Vector2d& pixel, const FrameView& from) const;
  Expected<GroundFix, NoFix> project(const Eigen::Vector2d& pixel, const FrameView& from,
                                     const GroundModel& ground) const;
  Expected<GroundFix, NoFix> fix_of_point(const Eigen::Vector3d& point_in_enu, const FrameView& from) const;
  std::optional<Eigen::Vector2d> reproject(const Eigen::Vector3d& position_in_enu,
                                           const FrameView& from) const;
  bool sees_point(const Eigen::Vector3d& position_in_enu, const FrameView& from, double margin_px) const;
  bool sees(const Eigen::Vector2d& position_in_enu, const FrameView& from, double margin_px,
            const GroundModel& ground) const;

  /// The camera's focal length [fx, fy] at a frame.
  Eigen::Vector2d focal_px(const FrameView& of) const {
    const CameraIntrinsics& camera = camera_.intrinsics();
    return of.focal_ratio * of.focal_px.value_or(Eigen::Vector2d(camera.fx_px, camera.fy_px));
  }

  /// Whether that may be another than the calibration's.
  static bool is_zoomed(const FrameView& view) { return view.focal_px || view.focal_ratio != 1.0; }

  /// With the calibration's focal length; what else it tells holds for every frame.
  const CameraModel& camera() const { return camera_; }
  const ProjectorConfig& config() const { return config_; }

 private:
  friend class FrameProjector;  // the same for several pixels at once
  struct PixelRay;

  /// What `ask` gets of the projector whose camera has the view's focal length.
  template <typename Ask>
  auto zoomed_as(const FrameView& view, const Ask& ask) const;
  Expected<PixelRay, NoFix> ray_of(const Eigen::Vector2d& pixel, const Rigid3d& enu_from_camera) const;
  Expected<double, NoFix> range_of_plane(const Ray<double>& ray) const;
  /// The reason why a ray from that height, which meets the plane at that range, has no fix.
  std::optional<NoFix> why_none(double camera_up_m, double direction_up, double range_m) const;

  ProjectorConfig config_;
  CameraModel camera_;
  double min_depression_sine_;
};

}  // namespace geoloc
