// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/world/camera_renderer.hpp"

#include <opencv2/imgproc.hpp>

#include "geoloc/geometry/problems.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "ground.hpp"
#include "ground_grid.hpp"
#include "ground_painter.hpp"
#include "ground_point.hpp"
#include "object_painter.hpp"
#include "sensor.hpp"
#include "shadow_painter.hpp"

namespace geoloc::sim {

std::vector<std::string> RenderSettings::problems() const {
  Problems found;
  found.require(exposure > 0 && exposure <= 10, "render.exposure must lie in (0, 10]");
  found.require(warmth >= -1 && warmth <= 1, "render.warmth must lie in [-1, 1]");
  found.require(vignetting >= 0 && vignetting < 1, "render.vignetting must lie in [0, 1)");
  found.require(focus_sigma_px >= 0 && focus_sigma_px <= 10, "render.focus_sigma_px must lie in [0, 10]");
  found.require(noise_sigma >= 0 && noise_sigma <= 100, "render.noise_sigma must lie in [0, 100]");
  found.require(visibility_m > 0, "render.visibility_m must be > 0");
  return found.take();
}

struct CameraRenderer::Buffers {
  Buffers(const CameraIntrinsics& intrinsics, const RenderSettings& settings)
      : camera(intrinsics),
        grid(camera),
        size(intrinsics.width_px, intrinsics.height_px),
        light(grid, size, settings),
        ground_painter(grid),
        sharp(size, CV_8UC3),
        noise(size, settings.noise_sigma, settings.seed) {}

  CameraModel camera;
  GroundGrid grid;
  cv::Size size;
  Light light;
  GroundPainter ground_painter;
  cv::Mat sharp;  // before lens and sensor
  SensorNoise noise;
};

CameraRenderer::CameraRenderer(const CameraIntrinsics& intrinsics, const Scene& scene,
                               const RenderSettings& settings)
    : CameraRenderer(intrinsics, scene, make_ground(scene.ground, scene.ground_seed), settings) {}

CameraRenderer::CameraRenderer(const CameraIntrinsics& intrinsics, const Scene& scene,
                               std::shared_ptr<const Ground> ground, const RenderSettings& settings)
    : objects_(scene.objects), shadows_(scene.shadows), ground_(std::move(ground)), settings_(settings) {
  refuse_if_any(settings.problems());
  buffers_ = std::make_unique<Buffers>(intrinsics, settings);
}

CameraRenderer::~CameraRenderer() = default;
CameraRenderer::CameraRenderer(CameraRenderer&&) noexcept = default;
CameraRenderer& CameraRenderer::operator=(CameraRenderer&&) noexcept = default;

void CameraRenderer::look_through(const CameraModel& camera) {
  buffers_->camera = camera;
  buffers_->grid.look_through(camera);
}

void CameraRenderer::render(const Rigid3d& enu_from_camera, const Eigen::Vector2d& blur_px, cv::Mat& bgr) {
  Buffers& work = *buffers_;
  const bool posed = enu_from_camera.translation.allFinite() &&
                     enu_from_camera.rotation.coeffs().allFinite() && enu_from_camera.rotation.norm() > 0.5;
  if (posed) {
    work.grid.look_from(enu_from_camera);
    work.ground_painter.paint(work.grid, *ground_, work.light, work.sharp);
    for (const PlacedObject& object : objects_) paint_object(work.grid, work.light, object, work.sharp);
    for (const Shadow& shadow : shadows_) cast_shadow(work.camera, enu_from_camera, shadow, work.sharp);
  } else {
    work.sharp.setTo(cv::Scalar::all(128));
  }
  cv::filter2D(work.sharp, bgr, -1, blur_kernel(settings_.focus_sigma_px, blur_px, kLongestBlur_px), {-1, -1},
               0.0, cv::BORDER_REPLICATE);
  work.noise.add_to(bgr);
}

Eigen::Vector2d image_motion_px(const CameraModel& camera, const Rigid3d& enu_from_camera_before,
                                const Rigid3d& enu_from_camera_after) {
  const Eigen::Vector2d middle{0.5 * (camera.intrinsics().width_px - 1),
                               0.5 * (camera.intrinsics().height_px - 1)};
  const auto ground = ground_point(camera, enu_from_camera_before, middle);
  if (!ground) return Eigen::Vector2d::Zero();
  const auto after = camera.pixel(enu_from_camera_after.inverse() * *ground);
  if (!after) return Eigen::Vector2d::Zero();
  return *after - middle;
}

}  // namespace geoloc::sim
