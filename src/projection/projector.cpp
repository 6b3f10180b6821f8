// SPDX-License-Identifier: Apache-2.0
#include "geoloc/projection/projector.hpp"

#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/ray_plane.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "projection/frame_projector.hpp"
#include "projection/projector_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc {
namespace {

/// Eq. 10 differentiated: where the unnormalized direction v = R (x, y, 1) is moved by the pixel, the point
/// o + t v moves by t dv, and along v until it is on the ground's plane again. `slope`: d height / d (east,
/// north) of that.
Eigen::Matrix2d ground_from_normalized(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& direction,
                                       double scale, const Eigen::Vector2d& slope) {
  const Eigen::Vector3d normal(-slope.x(), -slope.y(), 1.0);
  const Eigen::Matrix3d onto_ground =
      Eigen::Matrix3d::Identity() - direction * normal.transpose() / normal.dot(direction);
  return scale * onto_ground.topRows<2>() * rotation.leftCols<2>();
}

}  // namespace

std::vector<std::string> ProjectorConfig::problems() const {
  return check_fields(*this);
}

Projector::Projector(const ProjectorConfig& config, const CameraIntrinsics& intrinsics)
    : config_(config),
      camera_(intrinsics),
      min_depression_sine_(std::sin(config.min_depression_deg * kRadPerDeg)) {
  refuse_if_any(config.problems());
}

/// Checked to come down steeply enough from above the plane.
struct Projector::PixelRay {
  Ray<double> ray;
  Eigen::Matrix3d enu_from_camera;
  Eigen::Vector3d direction;  // not normalized: one along the optical axis
  Eigen::Matrix2d normalized_from_pixel;

  GroundFix meeting(double range_m, const Eigen::Vector2d& slope) const {
    const double scale = range_m / direction.norm();
    return {ray.at(range_m).head<2>(),
            ground_from_normalized(enu_from_camera, direction, scale, slope) * normalized_from_pixel,
            ray.direction, range_m};
  }
};

Expected<Projector::PixelRay, NoFix> Projector::ray_of(const Eigen::Vector2d& pixel,
                                                       const Rigid3d& enu_from_camera) const {
  if (!pixel.allFinite() || !enu_from_camera.translation.allFinite() ||
      !enu_from_camera.rotation.coeffs().allFinite()) {
    return NoFix::kNotFinite;
  }
  const auto image_ray = camera_.ray(pixel);
  if (!image_ray) return NoFix::kNoRay;
  const Eigen::Matrix3d rotation = enu_from_camera.rotation.toRotationMatrix();
  const Eigen::Vector3d direction = rotation * image_ray->normalized.homogeneous();
  return PixelRay{{enu_from_camera.translation, direction.normalized()},
                  rotation,
                  direction,
                  image_ray->normalized_from_pixel};
}

Expected<double, NoFix> Projector::range_of_plane(const Ray<double>& ray) const {
  const double range_m = (config_.ground_height_above_home_m - ray.origin.z()) / ray.direction.z();
  if (const auto none = why_none(ray.origin.z(), ray.direction.z(), range_m)) return *none;
  return range_m;
}

std::optional<NoFix> Projector::why_none(double camera_up_m, double direction_up, double range_m) const {
  if (!(camera_up_m - config_.ground_height_above_home_m > 0.0)) return NoFix::kBelowGround;
  if (!(direction_up < 0.0)) return NoFix::kAboveHorizon;
  if (!(-direction_up >= min_depression_sine_)) return NoFix::kTooGrazing;
  if (!(range_m <= config_.max_range_m)) return NoFix::kTooFar;
  return std::nullopt;
}

Expected<GroundFix, NoFix> Projector::project(const Eigen::Vector2d& pixel,
                                              const Rigid3d& enu_from_camera) const {
  const auto found = ray_of(pixel, enu_from_camera);
  if (!found) return found.error();
  const auto range_m = range_of_plane(found->ray);
  if (!range_m) return range_m.error();
  return found->meeting(*range_m, Eigen::Vector2d::Zero());
}

Expected<GroundFix, NoFix> Projector::fix_of_point(const Eigen::Vector3d& point_in_enu,
                                                   const Rigid3d& enu_from_camera) const {
  const Eigen::Matrix3d rotation = enu_from_camera.rotation.toRotationMatrix();
  const Eigen::Vector3d to_point = point_in_enu - enu_from_camera.translation;
  const auto image_ray = camera_.ray_to(rotation.transpose() * to_point);
  if (!image_ray) return NoFix::kNoRay;
  const double range_m = to_point.norm();
  const Ray<double> ray{enu_from_camera.translation, to_point / range_m};
  if (const auto seen = range_of_plane(ray); !seen) return seen.error();
  const PixelRay pixel_ray{ray, rotation, rotation * image_ray->normalized.homogeneous(),
                           image_ray->normalized_from_pixel};
  return pixel_ray.meeting(range_m, Eigen::Vector2d::Zero());
}

Expected<GroundFix, NoFix> Projector::project(const Eigen::Vector2d& pixel, const Rigid3d& enu_from_camera,
                                              const GroundModel& ground) const {
  if (ground.is_level()) return project(pixel, enu_from_camera);
  const auto found = ray_of(pixel, enu_from_camera);
  if (!found) return found.error();
  Ray<double> ray = found->ray;
  ray.origin.z() -= config_.ground_height_above_home_m;
  if (!(ray.origin.z() > ground.height_m(ray.origin.head<2>()))) return NoFix::kBelowGround;
  if (!(ray.direction.z() < 0.0)) return NoFix::kAboveHorizon;
  if (!(-ray.direction.z() >= min_depression_sine_)) return NoFix::kTooGrazing;
  const auto range_m = intersect(ray, ground, config_.max_range_m);
  if (!range_m) return NoFix::kTooFar;
  return found->meeting(*range_m, ground.at(ray.at(*range_m).head<2>()).slope);
}

void Projector::project(const std::vector<Eigen::Vector2d>& pixels, const Rigid3d& enu_from_camera,
                        std::vector<Expected<GroundFix, NoFix>>& fixes) const {
  fixes.clear();
  FrameProjector(*this, enu_from_camera)
      .project(
          pixels.size(), [&](std::size_t i) { return pixels[i]; },
          [&](std::size_t /*i*/, const Expected<GroundFix, NoFix>& fix) { fixes.push_back(fix); });
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
  return sees_point({position_in_enu.x(), position_in_enu.y(), config_.ground_height_above_home_m},
                    enu_from_camera, margin_px);
}

bool Projector::sees_point(const Eigen::Vector3d& position_in_enu, const Rigid3d& enu_from_camera,
                           double margin_px) const {
  const auto pixel = reproject(position_in_enu, enu_from_camera);
  if (!pixel || !camera_.contains(*pixel, margin_px)) return false;
  const Eigen::Vector3d to_point = position_in_enu - enu_from_camera.translation;
  return range_of_plane({enu_from_camera.translation, to_point.normalized()}).has_value();
}

bool Projector::sees(const Eigen::Vector2d& position_in_enu, const Rigid3d& enu_from_camera, double margin_px,
                     const GroundModel& ground) const {
  Eigen::Vector3d point_in_enu;
  point_in_enu << position_in_enu, config_.ground_height_above_home_m + ground.height_m(position_in_enu);
  const auto pixel = reproject(point_in_enu, enu_from_camera);
  return pixel && camera_.contains(*pixel, margin_px) && project(*pixel, enu_from_camera, ground).has_value();
}

/// A copy is made only where the camera zooms, or is known to be longer.
template <typename Ask>
auto Projector::zoomed_as(const FrameView& view, const Ask& ask) const {
  if (!is_zoomed(view)) return ask(*this);
  Projector zoomed = *this;
  zoomed.camera_ = camera_.with_focal_length(focal_px(view));
  return ask(zoomed);
}

Expected<GroundFix, NoFix> Projector::project(const Eigen::Vector2d& pixel, const FrameView& from) const {
  return zoomed_as(from, [&](const Projector& p) { return p.project(pixel, from.enu_from_camera); });
}

Expected<GroundFix, NoFix> Projector::project(const Eigen::Vector2d& pixel, const FrameView& from,
                                              const GroundModel& ground) const {
  return zoomed_as(from, [&](const Projector& p) { return p.project(pixel, from.enu_from_camera, ground); });
}

Expected<GroundFix, NoFix> Projector::fix_of_point(const Eigen::Vector3d& point_in_enu,
                                                   const FrameView& from) const {
  return zoomed_as(from,
                   [&](const Projector& p) { return p.fix_of_point(point_in_enu, from.enu_from_camera); });
}

std::optional<Eigen::Vector2d> Projector::reproject(const Eigen::Vector3d& position_in_enu,
                                                    const FrameView& from) const {
  return zoomed_as(from,
                   [&](const Projector& p) { return p.reproject(position_in_enu, from.enu_from_camera); });
}

bool Projector::sees_point(const Eigen::Vector3d& position_in_enu, const FrameView& from,
                           double margin_px) const {
  return zoomed_as(from, [&](const Projector& p) {
    return p.sees_point(position_in_enu, from.enu_from_camera, margin_px);
  });
}

bool Projector::sees(const Eigen::Vector2d& position_in_enu, const FrameView& from, double margin_px,
                     const GroundModel& ground) const {
  return zoomed_as(from, [&](const Projector& p) {
    return p.sees(position_in_enu, from.enu_from_camera, margin_px, ground);
  });
}

}  // namespace geoloc
