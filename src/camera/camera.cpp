// SPDX-License-Identifier: Apache-2.0
#include "geoloc/camera/camera.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "camera/camera_fields.hpp"
#include "camera/distortion.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "settings/field_checker.hpp"

namespace geoloc {
namespace {

Eigen::Matrix2d jacobian_of(const Distorted<double>& there) {
  Eigen::Matrix2d jacobian;
  jacobian << there.x_by_x, there.x_by_y,  //
      there.x_by_y, there.y_by_y;
  return jacobian;
}

bool is_invertible(const Eigen::Matrix2d& jacobian) {
  return std::abs(jacobian.determinant()) > Undistortion::kLeastDeterminant;
}

/// Takes a ray whose Jacobian is by the distorted coordinates.
ImageRay by_pixel(ImageRay ray, const CameraIntrinsics& intrinsics) {
  ray.normalized_from_pixel.col(0) /= intrinsics.fx_px;
  ray.normalized_from_pixel.col(1) /= intrinsics.fy_px;
  return ray;
}

/// Newton from the distorted point; nullopt where it does not settle or leaves the invertible disc. The
/// Jacobian is that of undistorted by distorted coordinates.
std::optional<ImageRay> undistort(const Eigen::Vector2d& distorted,
                                  const DistortionCoefficients& coefficients, double max_radius_squared) {
  Eigen::Vector2d estimate = distorted;
  for (int step = 0; step < Undistortion::kMaxSteps; ++step) {
    const Distorted<double> there = distort(estimate.x(), estimate.y(), coefficients);
    const Eigen::Matrix2d jacobian = jacobian_of(there);
    const Eigen::Vector2d residual = distorted - Eigen::Vector2d(there.x, there.y);
    if (residual.cwiseAbs().maxCoeff() < Undistortion::kTolerance) {
      if (!(estimate.squaredNorm() <= max_radius_squared)) return std::nullopt;
      return ImageRay{estimate, jacobian.inverse()};
    }
    if (!is_invertible(jacobian)) return std::nullopt;
    estimate += jacobian.inverse() * residual;
  }
  return std::nullopt;
}

bool has_distortion(const DistortionCoefficients& coefficients) {
  for (const double value : coefficients) {
    if (value != 0.0) return true;
  }
  return false;
}

/// The radius at which the radial model stops growing: beyond it a pixel would have two bearings.
double monotonic_radius_squared(const DistortionCoefficients& coefficients) {
  if (!has_distortion(coefficients)) return std::numeric_limits<double>::infinity();
  const auto [k1, k2, p1, p2, k3] = coefficients;
  constexpr double kStep = 0.01;
  constexpr double kWidest = 10.0;  // tan of 84 deg off axis
  double radius = 0.0;
  for (; radius < kWidest; radius += kStep) {
    const double r2 = (radius + kStep) * (radius + kStep);
    const double slope = 1.0 + r2 * (3.0 * k1 + r2 * (5.0 * k2 + r2 * 7.0 * k3));
    if (!(slope > 0.0)) break;
  }
  return radius * radius;
}

}  // namespace

CameraIntrinsics CameraIntrinsics::from_field_of_view(int width_px, int height_px,
                                                      double horizontal_fov_deg) {
  CameraIntrinsics intrinsics;
  intrinsics.width_px = width_px;
  intrinsics.height_px = height_px;
  intrinsics.fx_px = intrinsics.fy_px = 0.5 * width_px / std::tan(0.5 * horizontal_fov_deg * kRadPerDeg);
  intrinsics.cx_px = 0.5 * (width_px - 1);
  intrinsics.cy_px = 0.5 * (height_px - 1);
  return intrinsics;
}

bool is_focal_length(const Eigen::Vector2d& focal_px, const CameraIntrinsics& image) {
  return Range::positive().contains(focal_px.x()) && is_focal_length_for(focal_px.x(), image.width_px) &&
         Range::positive().contains(focal_px.y()) && is_focal_length_for(focal_px.y(), image.height_px);
}

std::vector<std::string> CameraConfig::problems() const {
  return check_fields(*this);
}

Eigen::Quaterniond body_from_forward_camera() {
  Eigen::Matrix3d rotation;
  rotation << 0, 0, 1,  // the body's forward is the camera's forward (z),
      1, 0, 0,          // its right the camera's right (x),
      0, 1, 0;          // its down the camera's down (y)
  return Eigen::Quaterniond(rotation);
}

CameraMount CameraMount::on_gimbal() {
  CameraMount mount;
  mount.kind = MountKind::kGimbal;
  mount.pitch_deg = 0.0;
  return mount;
}

CameraMount CameraMount::turned_to(const Eigen::Quaterniond& carrier_from_turned) const {
  const EulerAngles turn = euler_angles(carrier_from_turned);
  CameraMount mount = *this;
  mount.roll_deg = turn.roll_rad * kDegPerRad;
  mount.pitch_deg = turn.pitch_rad * kDegPerRad;
  mount.yaw_deg = turn.yaw_rad * kDegPerRad;
  return mount;
}

Rigid3d body_from_camera(const CameraMount& mount) {
  const EulerAngles angles{mount.roll_deg * kRadPerDeg, mount.pitch_deg * kRadPerDeg,
                           mount.yaw_deg * kRadPerDeg};
  // The same rotation sequence as the vehicle's in NED, here of the camera's carrier in the body.
  const Eigen::Quaterniond body_from_carrier = ned_from_body(angles);
  return {(body_from_carrier * body_from_forward_camera()).normalized(), {mount.x_m, mount.y_m, mount.z_m}};
}

CameraModel::CameraModel(const CameraIntrinsics& intrinsics)
    : intrinsics_(intrinsics), max_radius_squared_(monotonic_radius_squared(intrinsics.distortion)) {
  refuse_if_any(CameraConfig{intrinsics, {}}.problems());
}

CameraModel CameraModel::with_focal_length(const Eigen::Vector2d& focal_px) const {
  CameraModel zoomed = *this;
  zoomed.intrinsics_.fx_px = focal_px.x();
  zoomed.intrinsics_.fy_px = focal_px.y();
  return zoomed;
}

std::optional<ImageRay> CameraModel::ray(const Eigen::Vector2d& pixel) const {
  if (!pixel.allFinite()) return std::nullopt;
  const Eigen::Vector2d distorted{(pixel.x() - intrinsics_.cx_px) / intrinsics_.fx_px,
                                  (pixel.y() - intrinsics_.cy_px) / intrinsics_.fy_px};
  const auto undistorted = undistort(distorted, intrinsics_.distortion, max_radius_squared_);
  if (!undistorted) return std::nullopt;
  return by_pixel(*undistorted, intrinsics_);
}

std::optional<ImageRay> CameraModel::ray_to(const Eigen::Vector3d& point_in_camera) const {
  const auto there = normalized(point_in_camera);
  if (!there) return std::nullopt;
  const Eigen::Matrix2d jacobian = jacobian_of(distort(there->x(), there->y(), intrinsics_.distortion));
  if (!is_invertible(jacobian)) return std::nullopt;
  return by_pixel({*there, jacobian.inverse()}, intrinsics_);
}

/// Undistorted, at unit depth.
std::optional<Eigen::Vector2d> CameraModel::normalized(const Eigen::Vector3d& point_in_camera) const {
  if (!(point_in_camera.z() > 1e-6) || !point_in_camera.allFinite()) return std::nullopt;
  const Eigen::Vector2d normalized = point_in_camera.hnormalized();
  if (!(normalized.squaredNorm() <= max_radius_squared_)) return std::nullopt;
  return normalized;
}

std::optional<Eigen::Vector2d> CameraModel::pixel(const Eigen::Vector3d& point_in_camera) const {
  const auto there = normalized(point_in_camera);
  if (!there) return std::nullopt;
  const Distorted<double> distorted = distort(there->x(), there->y(), intrinsics_.distortion);
  return Eigen::Vector2d{intrinsics_.fx_px * distorted.x + intrinsics_.cx_px,
                         intrinsics_.fy_px * distorted.y + intrinsics_.cy_px};
}

bool CameraModel::contains(const Eigen::Vector2d& pixel, double margin_px) const {
  return pixel.x() >= -0.5 + margin_px && pixel.x() <= intrinsics_.width_px - 0.5 - margin_px &&
         pixel.y() >= -0.5 + margin_px && pixel.y() <= intrinsics_.height_px - 0.5 - margin_px;
}

}  // namespace geoloc
