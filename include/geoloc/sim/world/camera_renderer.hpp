// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/geometry/rigid3.hpp"
#include "geoloc/sim/world/scene.hpp"

namespace geoloc::sim {

struct Ground;

/// Light, lens and sensor.
struct RenderSettings {
  double exposure = 1.0;        ///< factor on all light; above about 1.2 white saturates
  double warmth = 0.0;          ///< white balance: -1 bluish, +1 reddish
  double vignetting = 0.2;      ///< fraction of the light lost in the corners
  double focus_sigma_px = 0.6;  ///< Gaussian blur of lens and sensor
  double noise_sigma = 3.0;     ///< grey levels
  double visibility_m = 4000;   ///< range at which haze hides 63 % of the contrast
  std::uint64_t seed = 1;       ///< of the noise

  /// Every fault, named by its JSON path.
  std::vector<std::string> problems() const;
};

/// Draws what a camera above the scene sees. Geometry is exact: every object is sampled at the place where
/// the line of sight through the (distorted) pixel meets the ground, to 0.1 px. All large buffers are
/// allocated once.
class CameraRenderer {
 public:
  /// Throws std::invalid_argument naming every problem of intrinsics and settings.
  CameraRenderer(const CameraIntrinsics& intrinsics, const Scene& scene, const RenderSettings& settings = {});

  /// The same with a ground that several cameras share, whatever ground the scene names.
  CameraRenderer(const CameraIntrinsics& intrinsics, const Scene& scene, std::shared_ptr<const Ground> ground,
                 const RenderSettings& settings);

  ~CameraRenderer();
  CameraRenderer(CameraRenderer&&) noexcept;
  CameraRenderer& operator=(CameraRenderer&&) noexcept;

  /// From now on through that camera, whose image is as large: it has zoomed.
  void look_through(const CameraModel& camera);

  /// bgr: CV_8UC3 of the camera's size, allocated where it is not yet. enu_from_camera: pose in the middle of
  /// the exposure; where it is not finite the picture is grey. blur_px: how far the picture moves during the
  /// exposure (see image_motion_px()); longer than kLongestBlur_px is cut, not finite is none.
  void render(const Rigid3d& enu_from_camera, const Eigen::Vector2d& blur_px, cv::Mat& bgr);

  static constexpr double kLongestBlur_px = 16.0;

 private:
  struct Buffers;

  std::vector<PlacedObject> objects_;
  std::vector<Shadow> shadows_;
  std::shared_ptr<const Ground> ground_;
  RenderSettings settings_;
  std::unique_ptr<Buffers> buffers_;
};

/// How far the ground in the middle of the picture moves through it while the camera goes from one pose to
/// the other; zero where the middle shows no ground.
Eigen::Vector2d image_motion_px(const CameraModel& camera, const Rigid3d& enu_from_camera_before,
                                const Rigid3d& enu_from_camera_after);

}  // namespace geoloc::sim
