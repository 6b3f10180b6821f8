// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/geometry/rigid3.hpp"

namespace geoloc {

/// Pinhole with Brown distortion, in OpenCV's conventions: pixel centres at integers, distortion k1 k2 p1 p2
/// k3.
struct CameraIntrinsics {
  int width_px = 1280;
  int height_px = 720;
  double fx_px = 914.01;
  double fy_px = 914.01;
  double cx_px = 639.5;
  double cy_px = 359.5;
  std::array<double, 5> distortion{};  ///< k1 k2 p1 p2 k3

  /// Square pixels, principal point in the middle, no distortion. The field of view spans the image's outer
  /// edges.
  static CameraIntrinsics from_field_of_view(int width_px, int height_px, double horizontal_fov_deg);
};

/// What carries the camera.
enum class MountKind {
  kFixed,  ///< the vehicle's body
  kGimbal  ///< a gimbal that reports how it holds the camera (GimbalSample)
};

/// The camera in its carrier: yaw, pitch, roll turn a camera that looks forward with its top up; looking
/// straight down with the image top towards the nose is pitch = -90 on a body, and 0 on a gimbal that says
/// so. The lever arm is in the body, forward-right-down, of a gimbal's camera too.
struct CameraMount {
  double roll_deg = 0.0;
  double pitch_deg = -90.0;
  double yaw_deg = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  MountKind kind = MountKind::kFixed;

  /// The mount of a camera that looks where its gimbal says.
  static CameraMount on_gimbal();

  /// The mount in the same place of a camera that is turned so: `carrier_from_turned` takes its forward,
  /// right and down to the carrier's. Near straight down, roll and yaw are one: it is yaw.
  CameraMount turned_to(const Eigen::Quaterniond& carrier_from_turned) const;
};

/// Whether a lens of that focal length [fx, fy] may see an image of that size: between 178 deg and 20 arc
/// seconds of it. False for NaN.
bool is_focal_length(const Eigen::Vector2d& focal_px, const CameraIntrinsics& image);

enum class CameraOrientation {
  kComposed,    ///< the mount turns in the body frame: enu_from_body * body_from_camera
  kAddedAngles  ///< the mount's angles are added to the vehicle's (paper, eq. 6): right only at small roll
                ///< and pitch
};

struct CameraConfig {
  CameraIntrinsics intrinsics;
  CameraMount mount;

  /// Every fault, named by its path; empty where the camera can be used.
  std::vector<std::string> problems() const;
};

/// Pose of the camera (right-down-forward) in the body (forward-right-down); of one on a gimbal, where that
/// holds it along the body's axes.
Rigid3d body_from_camera(const CameraMount& mount);

/// Rotation of a camera that looks along the body's forward axis with its top up.
Eigen::Quaterniond body_from_forward_camera();

/// A pixel's line of sight in the camera (right-down-forward): the direction is (normalized, 1), not unit
/// length.
struct ImageRay {
  Eigen::Vector2d normalized;             ///< without distortion, at unit depth
  Eigen::Matrix2d normalized_from_pixel;  ///< d normalized / d pixel [1/px]
};

/// Pixel <-> line of sight. Construction checks the intrinsics and measures where the distortion model can be
/// inverted.
class CameraModel {
 public:
  /// Throws std::invalid_argument naming every problem.
  explicit CameraModel(const CameraIntrinsics& intrinsics);

  /// The same camera zoomed to the focal length [fx, fy], which must be one (is_focal_length): its principal
  /// point and its distortion, which is a matter of normalized coordinates, stay.
  CameraModel with_focal_length(const Eigen::Vector2d& focal_px) const;

  /// K^-1 p of eq. 9; nullopt where the pixel is not finite or the distortion has no inverse there.
  std::optional<ImageRay> ray(const Eigen::Vector2d& pixel) const;

  /// The ray that shows a point in the camera (right-down-forward) [m]: that of pixel(), without inverting
  /// the lens. nullopt where pixel() has none.
  std::optional<ImageRay> ray_to(const Eigen::Vector3d& point_in_camera) const;

  /// Pixel of a point in the camera (right-down-forward) [m] (eq. 7); nullopt for a point behind the camera,
  /// too far off axis for the distortion model, or not finite. The pixel may lie outside the image.
  std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& point_in_camera) const;

  /// Within the image and at least margin_px away from its edges. False for NaN.
  bool contains(const Eigen::Vector2d& pixel, double margin_px = 0.0) const;

  const CameraIntrinsics& intrinsics() const { return intrinsics_; }

  /// The squared radius, in normalized undistorted coordinates, up to which the distortion is monotonic.
  double max_radius_squared() const { return max_radius_squared_; }

 private:
  std::optional<Eigen::Vector2d> normalized(const Eigen::Vector3d& point_in_camera) const;

  CameraIntrinsics intrinsics_;
  double max_radius_squared_;
};

}  // namespace geoloc
