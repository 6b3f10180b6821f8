// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/camera/detection.hpp"
#include "geoloc/geometry/rigid3.hpp"
#include "geoloc/state/vehicle_state.hpp"

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

/// One detection with its place on the ground.
struct LocatedDetection {
  Detection detection;
  GroundFix fix;
};

/// When a frame was taken, by both clocks, and what it tells of how.
struct FrameStamp {
  VehicleTime captured_at;
  HostTime captured_at_host;
  double time_sigma_s = 0.0;                        ///< 1-sigma; 0: not stated
  bool is_turned = false;                           ///< the vehicle's yaw is 180 deg from what it tells
  std::optional<CameraMount> mount = std::nullopt;  ///< where it is not the configured one
  std::optional<Eigen::Vector2d> focal_px = std::nullopt;  ///< [fx, fy], where it is not the calibration's
};

/// How the camera turns at a frame, and how well it is known how it was turned.
struct CameraTurn {
  Eigen::Vector3d rate_in_enu = Eigen::Vector3d::Zero();  ///< [rad/s]
  double sigma_rad = 0.0;       ///< that interpolation, or a gimbal's feedback, adds about each axis
  double sigma_bend_rad = 0.0;  ///< besides, where a turn may begin or end in between
  Duration telemetry_gap{};     ///< between the samples around: what interpolation is off by lasts so long
};

/// From where a frame was seen.
struct FrameView {
  VehicleState vehicle;  ///< at the instant that the frame is taken to show
  /// Calibration applied: turned, and lifted so that the ground lies in the projector's plane.
  Rigid3d enu_from_camera;
  HostTime captured_at_host;
  double lifted_m = 0.0;   ///< by so much
  double latency_s = 0.0;  ///< the vehicle's state is that of so long before the frame's stamp
  /// What lies in the projector's plane: the ground below the vehicle, so high above the level ground.
  double terrain_m = 0.0;
  CameraTurn turn;
  std::optional<Eigen::Vector2d> focal_px = std::nullopt;  ///< [fx, fy] then; nullopt: the calibration's
  double sigma_focal_share = 0.0;  ///< 1-sigma of it, as a share of it, while the camera zooms
  double focal_ratio = 1.0;        ///< the true focal length by that
};

}  // namespace geoloc
