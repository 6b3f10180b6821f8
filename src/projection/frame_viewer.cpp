// SPDX-License-Identifier: Apache-2.0
#include "projection/frame_viewer.hpp"

#include "projection/camera_pose.hpp"

namespace geoloc {
namespace {

VehicleState turned_round(VehicleState vehicle) {
  const Eigen::Quaterniond half_a_turn(0.0, 0.0, 0.0, 1.0);  // about the vertical
  vehicle.enu_from_body.rotation = half_a_turn * vehicle.enu_from_body.rotation;
  return vehicle;
}

}  // namespace

Expected<FrameView, NoState> FrameViewer::nominal_view(const FrameStamp& stamp, double latency_s) const {
  const auto told = state.at(stamp.captured_at - from_seconds(latency_s));
  if (!told) return told.error();
  const VehicleState vehicle = stamp.is_turned ? turned_round(*told) : *told;
  const CameraMount& mounted = stamp.mount ? *stamp.mount : mount;
  return FrameView{vehicle, enu_from_camera(vehicle, mounted, orientation), stamp.captured_at_host, 0.0,
                   latency_s};
}

FrameView calibrated(FrameView nominal_view, const Calibration& calibration, double lift_m) {
  calibration.turn(nominal_view.enu_from_camera);
  nominal_view.lifted_m = lift_m - nominal_view.terrain_m;
  nominal_view.enu_from_camera.translation.z() += nominal_view.lifted_m;
  return nominal_view;
}

}  // namespace geoloc
