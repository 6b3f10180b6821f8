// SPDX-License-Identifier: Apache-2.0
#include "projection/frame_viewer.hpp"

#include "projection/camera_pose.hpp"

namespace geoloc {
namespace {

VehicleState turned_round(VehicleState vehicle) {
  const Eigen::Quaterniond half_a_turn(0.0, 0.0, 0.0, 1.0);  // about the vertical
  vehicle.enu_from_body.rotation = half_a_turn * vehicle.enu_from_body.rotation;
  vehicle.enu_from_vehicle_ned = half_a_turn * vehicle.enu_from_vehicle_ned;
  return vehicle;
}

}  // namespace

Expected<FrameView, NoState> FrameViewer::nominal_view(const FrameStamp& stamp, double latency_s) const {
  const auto told = state.at(stamp.captured_at - from_seconds(latency_s));
  if (!told) return told.error();
  const VehicleState vehicle = stamp.is_turned ? turned_round(*told) : *told;
  const CameraMount& mounted = mount_of(stamp);
  FrameView view;
  view.vehicle = vehicle;
  view.captured_at_host = stamp.captured_at_host;
  view.latency_s = latency_s;
  if (stamp.focal_px) {
    view.focal_px = stamp.focal_px;
  } else if (const auto zoom = state.zoom().at(vehicle.time)) {
    view.focal_px = zoom->focal_px;
    view.sigma_focal_share = zoom->sigma_share;
  } else {
    return zoom.error();
  }
  if (mounted.kind == MountKind::kFixed) {
    view.enu_from_camera = enu_from_camera(vehicle, mounted, orientation);
    view.turn = turn_of(vehicle);
    return view;
  }
  const auto gimbal = state.gimbal_at(vehicle);
  if (!gimbal) return gimbal.error();
  view.enu_from_camera = enu_from_camera(vehicle, *gimbal, mounted);
  view.turn = turn_of(vehicle, *gimbal);
  return view;
}

bool FrameViewer::is_settled(const FrameStamp& stamp, VehicleTime time) const {
  return state.is_settled(time) && (stamp.focal_px || state.is_zoom_settled(time)) &&
         (mount_of(stamp).kind == MountKind::kFixed || state.gimbal().reaches_beyond(time));
}

FrameView calibrated(FrameView nominal_view, const Calibration& calibration, double lift_m) {
  calibration.turn(nominal_view.enu_from_camera);
  nominal_view.focal_ratio = calibration.focal_ratio();
  nominal_view.lifted_m = lift_m - nominal_view.terrain_m;
  nominal_view.enu_from_camera.translation +=
      calibration.position_lag_s() * nominal_view.vehicle.velocity_in_enu;
  nominal_view.enu_from_camera.translation.z() += nominal_view.lifted_m;
  return nominal_view;
}

}  // namespace geoloc
