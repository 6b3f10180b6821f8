// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/camera/camera.hpp"
#include "settings/rules.hpp"

namespace geoloc {

template <class Visitor>
void visit_fields(Visitor& v, CameraMount& mount) {
  constexpr Range kAngle = Range::closed(-360, 360);
  constexpr Range kLeverArm = Range::closed(-100, 100);
  v.field("roll_deg", mount.roll_deg, kAngle, "deg", "Roll of the camera in the body, applied last");
  v.field("pitch_deg", mount.pitch_deg, kAngle, "deg",
          "Pitch; -90 looks straight down, the image's top to the nose");
  v.field("yaw_deg", mount.yaw_deg, kAngle, "deg", "Yaw, clockwise from the nose, applied first");
  v.field("x_m", mount.x_m, kLeverArm, "m", "Lever arm forward");
  v.field("y_m", mount.y_m, kLeverArm, "m", "Lever arm to the right");
  v.field("z_m", mount.z_m, kLeverArm, "m", "Lever arm down");
}

template <class Visitor>
void visit_fields(Visitor& v, CameraConfig& camera) {
  CameraIntrinsics& intrinsics = camera.intrinsics;
  constexpr Range kSize = Range::closed(1, 32768);
  v.field("width", intrinsics.width_px, kSize, "px", "Width of the image");
  v.field("height", intrinsics.height_px, kSize, "px", "Height of the image");
  v.field("fx", intrinsics.fx_px, Range::positive(), "px", "Focal length along the image's width");
  v.field("fy", intrinsics.fy_px, Range::positive(), "px", "Focal length along the image's height");
  v.field("cx", intrinsics.cx_px, Range::finite(), "px", "Principal point; pixel centres are at integers");
  v.field("cy", intrinsics.cy_px, Range::finite(), "px", "Principal point; pixel centres are at integers");
  v.field("distortion", intrinsics.distortion, Range::finite(), "", "OpenCV's k1 k2 p1 p2 k3");
  v.section("mount", camera.mount);
}

}  // namespace geoloc
