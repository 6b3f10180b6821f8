// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/output_frame.hpp"

#include "geoloc/camera/field_of_view.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/state/state_provider.hpp"

namespace geoloc::io {
namespace {

GroundPoint ground_point(const LocalFrame& frame, const Eigen::Vector2d& position_in_enu) {
  return {frame.to_geodetic(position_in_enu), position_in_enu};
}

Eigen::Vector2d centre_px(const CameraIntrinsics& image) {
  return {0.5 * image.width_px - 0.5, 0.5 * image.height_px - 0.5};
}

std::optional<GroundPoint> seen_at(const Eigen::Vector2d& pixel, const Geolocator& geolocator) {
  const auto fix = geolocator.projector().project(pixel, geolocator.view());
  if (!fix) return std::nullopt;
  return ground_point(*geolocator.local_frame(), fix->position_in_enu);
}

CameraSight sight(const Geolocator& geolocator, double convergence_rad) {
  const FrameView& view = geolocator.view();
  const CameraIntrinsics& image = geolocator.projector().camera().intrinsics();
  const Eigen::Vector2d focal_px = geolocator.projector().focal_px(view);
  CameraSight sight = sight_of(view.enu_from_camera.rotation, convergence_rad);
  sight.horizontal_view_deg = angle_of_view_rad(image.width_px, focal_px.x()) * kDegPerRad;
  sight.vertical_view_deg = angle_of_view_rad(image.height_px, focal_px.y()) * kDegPerRad;
  if (const auto fix = geolocator.projector().project(centre_px(image), view)) sight.range_m = fix->range_m;
  return sight;
}

std::optional<std::array<GroundPoint, 4>> footprint(const Geolocator& geolocator) {
  const CameraIntrinsics& image = geolocator.projector().camera().intrinsics();
  const double right = image.width_px - 0.5, bottom = image.height_px - 0.5;
  const std::array<Eigen::Vector2d, 4> pixels{{{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}};
  std::array<GroundPoint, 4> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto corner = seen_at(pixels[i], geolocator);
    if (!corner) return std::nullopt;
    corners[i] = *corner;
  }
  return corners;
}

/// Against the vehicle's own axes, as if its nose pointed north and its wings were level.
CameraSight sight_in_vehicle(const FrameView& view) {
  const Eigen::Quaterniond body_from_camera =
      view.vehicle.enu_from_body.rotation.conjugate() * view.enu_from_camera.rotation;
  return sight_of(enu_from_ned() * body_from_camera, 0.0);
}

/// A height of the view, which is lifted.
HeightReport height_in(const Geolocator& geolocator, double in_view_m) {
  HeightReport height;
  height.above_home_m = in_view_m - geolocator.view().lifted_m;
  if (const auto home_msl_m = geolocator.state().home_height_msl_m())
    height.msl_m = *home_msl_m + height.above_home_m;
  return height;
}

ViewReport report_view(const Geolocator& geolocator) {
  const FrameView& view = geolocator.view();
  const Eigen::Vector3d& vehicle_in_enu = view.vehicle.enu_from_body.translation;
  const Geodetic vehicle = geolocator.local_frame()->to_geodetic(vehicle_in_enu.head<2>());
  const double convergence_rad = geolocator.local_frame()->to_local(vehicle).convergence_rad;
  const EulerAngles angles = euler_angles(enu_from_ned().conjugate() * view.vehicle.enu_from_body.rotation);
  const CameraIntrinsics& image = geolocator.projector().camera().intrinsics();
  ViewReport report;
  report.vehicle = vehicle;
  report.vehicle_in_enu = vehicle_in_enu;
  report.roll_deg = angles.roll_rad * kDegPerRad;
  report.pitch_deg = angles.pitch_rad * kDegPerRad;
  report.yaw_deg = wrap_to_pi(angles.yaw_rad - convergence_rad) * kDegPerRad;
  report.enu_from_camera = view.enu_from_camera;
  report.footprint = footprint(geolocator);
  report.image_centre = seen_at(centre_px(image), geolocator);
  report.sight = sight(geolocator, convergence_rad);
  report.camera = geolocator.local_frame()->to_geodetic(view.enu_from_camera.translation.head<2>());
  report.camera_in_vehicle = sight_in_vehicle(view);
  report.camera_height = height_in(geolocator, view.enu_from_camera.translation.z());
  report.ground_height = height_in(geolocator, geolocator.projector().config().ground_height_above_home_m);
  return report;
}

}  // namespace

OutputFrame FrameReporter::report(const Geolocator& geolocator, bool is_located, HostTime captured_at,
                                  const std::vector<Detection>& detections) {
  const Geodetic origin = geolocator.local_frame() ? geolocator.local_frame()->origin() : Geodetic{};
  if (origin.latitude_deg != origin_.latitude_deg || origin.longitude_deg != origin_.longitude_deg) {
    objects_.clear();
    tentative_.clear();
    origin_ = origin;
  }
  update_reports(geolocator, class_names_, TrackStatus::kConfirmed, objects_);
  update_reports(geolocator, class_names_, TrackStatus::kTentative, tentative_);
  OutputFrame frame;
  frame.captured_at = captured_at;
  frame.detections = detections;
  frame.objects = objects_;
  frame.tentative = tentative_;
  frame.estimator = report_estimator(geolocator);
  if (!is_located) return frame;
  frame.view = report_view(geolocator);
  for (const LocatedDetection& located : geolocator.located()) {
    frame.fixes.push_back({located.detection,
                           ground_point(*geolocator.local_frame(), located.fix.position_in_enu),
                           located.fix.range_m,
                           {}});
  }
  return frame;
}

}  // namespace geoloc::io
