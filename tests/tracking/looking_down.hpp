// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

#include "tracking/joint_frame.hpp"

namespace geoloc::testing {

/// A camera that looks straight down on the origin: a pixel is 2 cm of ground, and the image reaches 12.8 m
/// east and west and 7.2 m north and south.
struct LookingDown {
  static constexpr double kFocal_px = 1000.0, kUp_m = 20.0;

  LookingDown() {
    const Eigen::Matrix3d rotation = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
    view.enu_from_camera = {Eigen::Quaterniond(rotation), {0.0, 0.0, kUp_m}};
  }

  static CameraIntrinsics intrinsics() {
    CameraIntrinsics camera;
    camera.width_px = 1280;
    camera.height_px = 720;
    camera.fx_px = camera.fy_px = kFocal_px;
    camera.cx_px = (camera.width_px - 1) / 2.0;
    camera.cy_px = (camera.height_px - 1) / 2.0;
    return camera;
  }

  JointFrame frame_at(double time_s) {
    view.vehicle.time = VehicleTime{from_seconds(time_s)};
    return {projector, view, NodeSpan{0, 0.0}, NodeVector::Zero(), NoiseRepetition{}, 0.0, 0.1};
  }

  Projector projector{{}, intrinsics()};
  FrameView view;
};

}  // namespace geoloc::testing
