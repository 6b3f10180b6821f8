// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>

#include "geoloc/camera/camera.hpp"
#include "settings/rules.hpp"

namespace geoloc {

inline constexpr Range kMountAngle_deg = Range::closed(-360, 360);
inline constexpr Range kLeverArm_m = Range::closed(-100, 100);

/// Whether it can be a camera's. False for NaN.
inline bool is_usable(const CameraMount& mount) {
  return kMountAngle_deg.contains(mount.roll_deg) && kMountAngle_deg.contains(mount.pitch_deg) &&
         kMountAngle_deg.contains(mount.yaw_deg) && kLeverArm_m.contains(mount.x_m) &&
         kLeverArm_m.contains(mount.y_m) && kLeverArm_m.contains(mount.z_m);
}

template <>
struct EnumNames<MountKind> {
  static constexpr std::array<std::pair<MountKind, const char*>, 2> all{
      {{MountKind::kFixed, "fixed"}, {MountKind::kGimbal, "gimbal"}}};
};

template <class Visitor>
void visit_fields(Visitor& v, CameraMount& mount) {
  v.field(
      "kind", mount.kind, Any{}, "",
      "The camera is fixed to the body, or on a gimbal whose angles the telemetry tells: the angles below "
      "are then 0 for a camera that looks where the gimbal says");
  v.field("roll_deg", mount.roll_deg, kMountAngle_deg, "deg",
          "Roll of the camera in the body, or in the gimbal's axes; applied last");
  v.field("pitch_deg", mount.pitch_deg, kMountAngle_deg, "deg",
          "Pitch; -90 looks straight down, the image's top to the nose. On a gimbal the default is 0");
  v.field("yaw_deg", mount.yaw_deg, kMountAngle_deg, "deg", "Yaw, clockwise from the nose, applied first");
  v.field("x_m", mount.x_m, kLeverArm_m, "m", "Lever arm forward");
  v.field("y_m", mount.y_m, kLeverArm_m, "m", "Lever arm to the right");
  v.field("z_m", mount.z_m, kLeverArm_m, "m", "Lever arm down");
}

inline constexpr Range kImageSize = Range::closed(1, 32768);

/// Whether a lens of that focal length may see an image of that size: between 178 deg and 20 arc seconds of
/// it. Values that are out of their own ranges are no matter of this.
inline bool is_focal_length_for(double focal_length_px, int size_px) {
  if (!Range::positive().contains(focal_length_px) || !kImageSize.contains(size_px)) return true;
  return Range::closed(0.01 * size_px, 1e4 * size_px).contains(focal_length_px);
}

template <class Visitor>
void visit_fields(Visitor& v, CameraConfig& camera) {
  CameraIntrinsics& intrinsics = camera.intrinsics;
  constexpr Range kPrincipalPoint = Range::closed(-1e6, 1e6);
  constexpr Range kDistortion = Range::closed(-1e6, 1e6);
  constexpr const char* kFocalLength = "must be 0.01 to 10000 times the image's size that way";
  v.field("width", intrinsics.width_px, kImageSize, "px", "Width of the image");
  v.field("height", intrinsics.height_px, kImageSize, "px", "Height of the image");
  v.field("fx", intrinsics.fx_px, Range::positive(), "px",
          "Focal length along the image's width, 0.01 to 10000 times that");
  v.relation("fx", intrinsics.fx_px, is_focal_length_for(intrinsics.fx_px, intrinsics.width_px),
             kFocalLength);
  v.field("fy", intrinsics.fy_px, Range::positive(), "px",
          "Focal length along the image's height, 0.01 to 10000 times that");
  v.relation("fy", intrinsics.fy_px, is_focal_length_for(intrinsics.fy_px, intrinsics.height_px),
             kFocalLength);
  v.field("cx", intrinsics.cx_px, kPrincipalPoint, "px", "Principal point; pixel centres are at integers");
  v.field("cy", intrinsics.cy_px, kPrincipalPoint, "px", "Principal point; pixel centres are at integers");
  v.field("distortion", intrinsics.distortion, kDistortion, "", "OpenCV's k1 k2 p1 p2 k3");
  v.section("mount", camera.mount);
}

}  // namespace geoloc
