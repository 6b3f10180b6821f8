// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/simulated_detector.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "geoloc/geometry/problems.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "geoloc/sim/flight/random_stream.hpp"
#include "geoloc/sim/flight/run_settings.hpp"

namespace geoloc::sim {
namespace {

constexpr double kSmallestClutter_px = 18.0;
constexpr double kLargestClutter_px = 60.0;

Eigen::AlignedBox2d image_area(const CameraIntrinsics& intrinsics) {
  return {Eigen::Vector2d{-0.5, -0.5},
          Eigen::Vector2d{intrinsics.width_px - 0.5, intrinsics.height_px - 0.5}};
}

/// From the camera model's coordinates, where integers are pixel centres, to a box's, where the left edge is
/// 0.
Box to_box(const Eigen::AlignedBox2d& area) {
  return {area.min().x() + 0.5, area.min().y() + 0.5, area.sizes().x(), area.sizes().y()};
}

bool is_rate(double value) {
  return value >= 0.0 && value <= 1.0;
}

}  // namespace

std::vector<std::string> DetectorModel::problems() const {
  Problems found;
  found.require(target_size_m > 0.0 && target_size_m <= 100.0, "target_size must lie in (0, 100] m");
  found.require(pixel_noise_px >= 0.0 && pixel_noise_px <= 1000.0, "pixel_noise must lie in [0, 1000] px");
  found.require(is_rate(miss_rate), "miss_rate must lie in [0, 1]");
  found.require(clutter_rate >= 0.0 && clutter_rate <= 100.0, "clutter_rate must lie in [0, 100]");
  for (const auto& [least, most] : {confidence, clutter_confidence})
    found.require(is_rate(least) && is_rate(most) && least <= most,
                  "confidences must lie in [0, 1], the least first");
  found.require(is_rate(min_visible_fraction), "min_visible_fraction must lie in [0, 1]");
  return found.take();
}

std::optional<Box> disc_in_image(const CameraModel& camera, const Rigid3d& camera_from_enu,
                                 const Eigen::Vector3d& centre_in_enu, const DetectorModel& model) {
  const auto project = [&](const Eigen::Vector3d& point_in_enu) {
    return camera.pixel(camera_from_enu * point_in_enu);
  };
  const auto centre = project(centre_in_enu);
  if (!centre) return std::nullopt;
  constexpr int kOutlinePoints = 16;
  Eigen::AlignedBox2d outline;
  for (int i = 0; i < kOutlinePoints; ++i) {
    const double direction = 2.0 * kPi * i / kOutlinePoints;
    const Eigen::Vector3d rim{std::cos(direction), std::sin(direction), 0.0};
    const auto pixel = project(centre_in_enu + 0.5 * model.target_size_m * rim);
    if (!pixel) return std::nullopt;
    outline.extend(*pixel);
  }
  const Eigen::AlignedBox2d visible = outline.intersection(image_area(camera.intrinsics()));
  if (visible.isEmpty() || !(visible.volume() > 0.0)) return std::nullopt;
  if (!(visible.volume() >= model.min_visible_fraction * outline.volume())) return std::nullopt;
  return to_box(visible);
}

SimulatedDetector::SimulatedDetector(const DetectorModel& model, const CameraIntrinsics& intrinsics,
                                     std::vector<Eigen::Vector3d> targets_in_enu, std::uint64_t seed)
    : model_(model),
      camera_(intrinsics),
      targets_in_enu_(std::move(targets_in_enu)),
      detections_(stream_seed(seed, RandomStream::kDetections)),
      clutter_(stream_seed(seed, RandomStream::kClutter)) {
  refuse_if_any(model.problems());
}

std::vector<Detection> SimulatedDetector::detect(const Rigid3d& enu_from_camera, double zoom) {
  const CameraModel camera = zoomed(camera_, zoom);
  const Rigid3d camera_from_enu = enu_from_camera.inverse();
  std::vector<Detection> found;
  for (const Eigen::Vector3d& target_in_enu : targets_in_enu_) {
    auto box = disc_in_image(camera, camera_from_enu, target_in_enu, model_);
    if (!box) continue;
    // Drawn whether or not the target is missed, so that another miss rate leaves the noise alone.
    const bool missed = detections_.chance(model_.miss_rate);
    box->x += model_.pixel_noise_px * detections_.normal();
    box->y += model_.pixel_noise_px * detections_.normal();
    const double confidence = detections_.uniform(model_.confidence[0], model_.confidence[1]);
    if (!missed) found.push_back({*box, confidence, 0});
  }
  for (int i = draw_clutter_count(); i > 0; --i) found.push_back(draw_clutter());
  const auto more_confident = [](const Detection& a, const Detection& b) {
    return a.confidence > b.confidence;
  };
  std::stable_sort(found.begin(), found.end(), more_confident);
  return found;
}

int SimulatedDetector::draw_clutter_count() {
  const double whole = std::floor(model_.clutter_rate);
  return static_cast<int>(whole) + (clutter_.chance(model_.clutter_rate - whole) ? 1 : 0);
}

Detection SimulatedDetector::draw_clutter() {
  Box box;
  box.width = clutter_.uniform(kSmallestClutter_px, kLargestClutter_px);
  box.height = clutter_.uniform(kSmallestClutter_px, kLargestClutter_px);
  box.x = clutter_.uniform(0.0, std::max(0.0, camera_.intrinsics().width_px - box.width));
  box.y = clutter_.uniform(0.0, std::max(0.0, camera_.intrinsics().height_px - box.height));
  return {box, clutter_.uniform(model_.clutter_confidence[0], model_.clutter_confidence[1]), 0};
}

}  // namespace geoloc::sim
