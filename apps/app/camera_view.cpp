// SPDX-License-Identifier: Apache-2.0
#include "app/camera_view.hpp"

#include "common/frame_looks.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/io/output/object_report.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/state/state_provider.hpp"

namespace geoloc::apps {
namespace {

/// 0..1 from the image's left and top edge; nullopt outside of it.
std::optional<Eigen::Vector2d> image_point(const Geolocator& geolocator,
                                           const Eigen::Vector3d& position_in_enu) {
  const Projector& projector = geolocator.projector();
  const auto pixel = projector.reproject(position_in_enu, geolocator.view());
  if (!pixel || !projector.camera().contains(*pixel)) return std::nullopt;
  const CameraIntrinsics& image = projector.camera().intrinsics();
  return Eigen::Vector2d((pixel->x() + 0.5) / image.width_px, (pixel->y() + 0.5) / image.height_px);
}

io::CameraTarget target_of(const Track& track, const Geolocator& geolocator) {
  const Eigen::Vector2d& mean = track.position_in_enu.mean;
  const Eigen::Vector3d in_view = position_in_view(track, geolocator);
  io::CameraTarget target;
  target.id = track.id;
  target.position = geolocator.local_frame()->to_geodetic(mean);
  target.sigma_horizontal_m = io::error_ellipse(track.position_in_enu.covariance).sigma_major_m;
  const io::HeightReport height = io::height_of(track, geolocator);
  target.height_msl_m = height.msl_m;
  target.sigma_height_m = height.sigma_m;
  target.distance_m = (in_view - geolocator.view().enu_from_camera.translation).norm();
  target.image_point = image_point(geolocator, in_view);
  return target;
}

}  // namespace

io::CameraView camera_view(const Geolocator& geolocator, HostTime captured_at) {
  const Rigid3d& enu_from_camera = geolocator.view().enu_from_camera;
  const LocalFrame& frame = *geolocator.local_frame();
  const CameraIntrinsics& image = geolocator.projector().camera().intrinsics();
  io::CameraView view;
  view.captured_at = captured_at;
  view.time = geolocator.view().vehicle.time;
  view.focal_px = geolocator.projector().focal_px(geolocator.view());
  view.camera = frame.to_geodetic(enu_from_camera.translation.head<2>());
  if (const auto home_height_msl_m = geolocator.state().home_height_msl_m()) {
    const double home_in_view_msl_m = *home_height_msl_m - geolocator.view().lifted_m;
    view.camera_height_msl_m = home_in_view_msl_m + enu_from_camera.translation.z();
    view.ground_height_msl_m =
        home_in_view_msl_m + geolocator.projector().config().ground_height_above_home_m;
  }
  view.ned_from_camera = enu_from_ned().conjugate() * enu_from_camera.rotation *
                         body_from_forward_camera().conjugate();  // its axes to forward, right, down
  const auto centre = geolocator.projector().project(
      {0.5 * image.width_px - 0.5, 0.5 * image.height_px - 0.5}, geolocator.view());
  if (centre) view.image_centre = frame.to_geodetic(centre->position_in_enu);
  for (const Track& track : geolocator.tracks()) {
    if (track.status == TrackStatus::kConfirmed) view.targets.push_back(target_of(track, geolocator));
  }
  return view;
}

}  // namespace geoloc::apps
