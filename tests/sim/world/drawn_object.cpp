// SPDX-License-Identifier: Apache-2.0
#include "sim/world/drawn_object.hpp"

#include <opencv2/imgproc.hpp>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/sim/world/camera_renderer.hpp"

namespace geoloc::sim {

Rigid3d pose_above(double height_m, double roll_deg, double pitch_deg, double yaw_deg) {
  const EulerAngles attitude{roll_deg * kRadPerDeg, pitch_deg * kRadPerDeg, yaw_deg * kRadPerDeg};
  const Rigid3d enu_from_body{enu_from_ned() * ned_from_body(attitude), {0.0, 0.0, height_m}};
  return enu_from_body * body_from_camera({});
}

CameraIntrinsics barrel_camera() {
  CameraIntrinsics intrinsics = CameraIntrinsics::from_field_of_view(1280, 720, 70.0);
  intrinsics.cx_px += 7.0;
  intrinsics.distortion = {-0.15, 0.03, 0.0008, -0.0005, 0.0};
  return intrinsics;
}

cv::Mat drawn_object(const CameraIntrinsics& intrinsics, const PlacedObject& object,
                     const Rigid3d& enu_from_camera, const Eigen::Vector2d& blur_px) {
  Scene scene;
  scene.ground = GroundStyle::kAsphalt;
  RenderSettings settings;
  settings.noise_sigma = 0.0;
  cv::Mat without, with, difference, grey;
  CameraRenderer(intrinsics, scene, settings).render(enu_from_camera, blur_px, without);
  scene.objects = {object};
  CameraRenderer(intrinsics, scene, settings).render(enu_from_camera, blur_px, with);
  cv::absdiff(with, without, difference);
  cv::cvtColor(difference, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, CV_32FC1);
  return grey;
}

Eigen::Vector2d centre_of_mass(const cv::Mat& grey) {
  const cv::Moments moments = cv::moments(grey);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

}  // namespace geoloc::sim
