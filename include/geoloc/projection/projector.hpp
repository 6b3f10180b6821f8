// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/geometry/expected.hpp"
#include "geoloc/geometry/rigid3.hpp"

namespace geoloc {

struct ProjectorConfig {
  double ground_height_above_home_m = 0.0;
  double max_range_m = 1000.0;
  double min_depression_deg = 5.0;

  std::vector<std::string> problems() const;
};

/// Where a pixel's ray meets the ground.
struct GroundFix {
  Eigen::Vector2d position_in_enu = Eigen::Vector2d::Zero();    ///< east, north [m]
  Eigen::Matrix2d ground_from_pixel = Eigen::Matrix2d::Zero();  ///< d (east, north) / d (u, v) [m/px]
  Eigen::Vector3d direction_in_enu = Eigen::Vector3d::Zero();   ///< of the ray, unit length
  double range_m = 0.0;                                         ///< from the camera

  /// Covariance [m^2] that isotropic noise of the pixel causes.
  Eigen::Matrix2d covariance(double sigma_px) const {
    return sigma_px * sigma_px * ground_from_pixel * ground_from_pixel.transpose();
  }
};

enum class NoFix {
  kNotFinite,     ///< the pixel or the pose is not a number
  kNoRay,         ///< the lens distortion has no inverse at this pixel
  kAboveHorizon,  ///< the ray does not come down
  kTooGrazing,    ///< it meets the ground at too small an angle
  kTooFar,        ///< beyond max_range_m
  kBelowGround    ///< the camera is not above the ground plane
};
inline constexpr std::size_t kNoFixReasons = 6;

/// Pixel to ground point on a horizontal plane, and back (paper, eq. 7-10).
class Projector {
 public:
  /// Throws std::invalid_argument naming every problem.
  Projector(const ProjectorConfig& config, const CameraIntrinsics& intrinsics);

  /// `enu_from_camera`: pose at the capture time, up measured from home.
  Expected<GroundFix, NoFix> project(const Eigen::Vector2d& pixel, const Rigid3d& enu_from_camera) const;

  /// All pixels of one frame; fixes[i] belongs to pixels[i]. `fixes` is overwritten, within its capacity.
  void project(const std::vector<Eigen::Vector2d>& pixels, const Rigid3d& enu_from_camera,
               std::vector<Expected<GroundFix, NoFix>>& fixes) const;

  /// Pixel of a ground point; nullopt behind the camera or beyond its lens model. It may lie outside the
  /// image.
  std::optional<Eigen::Vector2d> reproject(const Eigen::Vector2d& position_in_enu,
                                           const Rigid3d& enu_from_camera) const;

  /// In the image, at least margin_px from its edge, and where project() would answer.
  bool sees(const Eigen::Vector2d& position_in_enu, const Rigid3d& enu_from_camera, double margin_px) const;

  const CameraModel& camera() const { return camera_; }
  const ProjectorConfig& config() const { return config_; }

 private:
  ProjectorConfig config_;
  CameraModel camera_;
  double min_depression_sine_;
};

}  // namespace geoloc
