// SPDX-License-Identifier: Apache-2.0
#include "geoloc/projection/projector.hpp"

#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/problems.hpp"
#include "geoloc/geometry/ray_plane.hpp"
#include "projection/projector_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc {
namespace {

/// Eq. 10 differentiated: P = o + (h / -v_z) v for the unnormalized direction v = R (x, y, 1), moved by the
/// pixel.
Eigen::Matrix2d ground_from_normalized(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& direction,
                                       double height_above_ground_m) {
  const double scale = height_above_ground_m / -direction.z();
  const Eigen::Matrix<double, 2, 3> ground_from_direction =
      scale *
      (Eigen::Matrix<double, 2, 3>() << Eigen::Matrix2d::Identity(), -direction.head<2>() / direction.z())
          .finished();
  return ground_from_direction * rotation.leftCols<2>();
}

}  // namespace

std::vector<std::string> ProjectorConfig::problems() const {
  return check_fields(*this);
}

Projector::Projector(const ProjectorConfig& config, const CameraIntrinsics& intrinsics)
    : config_(config),
      camera_(intrinsics),
      min_depression_sine_(std::sin(config.min_depression_deg * kRadPerDeg)) {
  throw_if_any(config.problems());
}

Expected<GroundFix, NoFix> Projector::project(const Eigen::Vector2d& pixel,
                                              const Rigid3d& enu_from_camera) const {
  if (!pixel.allFinite() || !enu_from_camera.translation.allFinite() ||
      !enu_from_camera.rotation.coeffs().allFinite()) {
    return NoFix::kNotFinite;
  }
  const auto image_ray = camera_.ray(pixel);
  if (!image_ray) return NoFix::kNoRay;

  const Eigen::Matrix3d rotation = enu_from_camera.rotation.toRotationMatrix();
  const Eigen::Vector3d direction = rotation * image_ray->normalized.homogeneous();
  const Ray<double> ray{enu_from_camera.translation, direction.normalized()};
  const Plane<double> ground{Eigen::Vector3d::UnitZ(), config_.ground_height_above_home_m};

  const double height_above_ground_m = ray.origin.z() - ground.offset_m;
  if (!(height_above_ground_m > 0.0)) return NoFix::kBelowGround;
  if (!(ray.direction.z() < 0.0)) return NoFix::kAboveHorizon;
  if (!(-ray.direction.z() >= min_depression_sine_)) return NoFix::kTooGrazing;
  const auto range_m = intersect(ray, ground);
  if (!range_m) return NoFix::kAboveHorizon;
  if (!(*range_m <= config_.max_range_m)) return NoFix::kTooFar;

  return GroundFix{
      ray.at(*range_m).head<2>(),
      ground_from_normalized(rotation, direction, height_above_ground_m) * image_ray->normalized_from_pixel,
      ray.direction, *range_m};
}

void Projector::project(const std::vector<Eigen::Vector2d>& pixels, const Rigid3d& enu_from_camera,
                        std::vector<Expected<GroundFix, NoFix>>& fixes) const {
  fixes.clear();
  for (const Eigen::Vector2d& pixel : pixels) fixes.push_back(project(pixel, enu_from_camera));
}

std::optional<Eigen::Vector2d> Projector::reproject(const Eigen::Vector2d& position_in_enu,
                                                    const Rigid3d& enu_from_camera) const {
  Eigen::Vector3d point_in_enu;
  point_in_enu << position_in_enu, config_.ground_height_above_home_m;
  return reproject(point_in_enu, enu_from_camera);
}

std::optional<Eigen::Vector2d> Projector::reproject(const Eigen::Vector3d& position_in_enu,
                                                    const Rigid3d& enu_from_camera) const {
  return camera_.pixel(enu_from_camera.inverse() * position_in_enu);
}

bool Projector::sees(const Eigen::Vector2d& position_in_enu, const Rigid3d& enu_from_camera,
                     double margin_px) const {
  const auto pixel = reproject(position_in_enu, enu_from_camera);
  return pixel && camera_.contains(*pixel, margin_px) && project(*pixel, enu_from_camera).has_value();
}

}  // namespace geoloc
