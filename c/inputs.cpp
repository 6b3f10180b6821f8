// SPDX-License-Identifier: Apache-2.0
#include "inputs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "last_error.hpp"

namespace geoloc::c {
namespace {

/// Differences of two times of that size, and what is added to them, are 64-bit numbers still.
constexpr std::int64_t kFarthestTime_ns = 4'000'000'000'000'000'000;

Duration duration(std::int64_t time_ns, const char* name) {
  if (time_ns < -kFarthestTime_ns || time_ns > kFarthestTime_ns)
    throw BadArgument(std::string(name) + " is beyond 4e18, but is " + std::to_string(time_ns));
  return Duration{time_ns};
}

VehicleTime vehicle_time(std::int64_t time_ns, const char* name) {
  return VehicleTime{duration(time_ns, name)};
}

double finite(double value, const char* name) {
  if (!std::isfinite(value)) throw BadArgument(std::string(name) + " is not a finite number");
  return value;
}

double at_least_zero(double value, const char* name) {
  if (!(finite(value, name) >= 0.0)) throw BadArgument(std::string(name) + " is less than 0");
  return value;
}

template <typename Enum>
Enum one_of_two(std::int32_t value, const char* name) {
  if (value != 0 && value != 1)
    throw BadArgument(std::string(name) + " is 0 or 1, but is " + std::to_string(value));
  return static_cast<Enum>(value);
}

Eigen::Vector3d vector3(const double (&values)[3], const char* name) {
  return {finite(values[0], name), finite(values[1], name), finite(values[2], name)};
}

std::optional<double> unless_zero(double value, const char* name) {
  return at_least_zero(value, name) > 0.0 ? std::optional<double>(value) : std::nullopt;
}

CameraMount mount_from(const geoloc_mount& mount) {
  return {mount.roll_deg,
          mount.pitch_deg,
          mount.yaw_deg,
          mount.x_m,
          mount.y_m,
          mount.z_m,
          one_of_two<MountKind>(mount.kind, "mount.kind")};
}

Detection detection_from(const geoloc_detection& given) {
  Detection detection;
  detection.box = {finite(given.x_px, "detection.x_px"), finite(given.y_px, "detection.y_px"),
                   finite(given.width_px, "detection.width_px"),
                   finite(given.height_px, "detection.height_px")};
  detection.confidence = finite(given.confidence, "detection.confidence");
  detection.class_id = given.class_id;
  detection.sigma_px = finite(given.sigma_px, "detection.sigma_px");
  return detection;
}

}  // namespace

geoloc_camera to_c(const CameraConfig& camera) {
  const CameraIntrinsics& intrinsics = camera.intrinsics;
  const CameraMount& mount = camera.mount;
  geoloc_camera result{};
  result.width_px = intrinsics.width_px;
  result.height_px = intrinsics.height_px;
  result.fx_px = intrinsics.fx_px;
  result.fy_px = intrinsics.fy_px;
  result.cx_px = intrinsics.cx_px;
  result.cy_px = intrinsics.cy_px;
  std::copy(intrinsics.distortion.begin(), intrinsics.distortion.end(), result.distortion);
  result.mount = {mount.roll_deg,
                  mount.pitch_deg,
                  mount.yaw_deg,
                  mount.x_m,
                  mount.y_m,
                  mount.z_m,
                  static_cast<std::int32_t>(mount.kind)};
  return result;
}

CameraConfig camera_from(const geoloc_camera& camera) {
  CameraConfig result;
  result.intrinsics.width_px = camera.width_px;
  result.intrinsics.height_px = camera.height_px;
  result.intrinsics.fx_px = camera.fx_px;
  result.intrinsics.fy_px = camera.fy_px;
  result.intrinsics.cx_px = camera.cx_px;
  result.intrinsics.cy_px = camera.cy_px;
  std::copy_n(camera.distortion, result.intrinsics.distortion.size(), result.intrinsics.distortion.begin());
  result.mount = mount_from(camera.mount);
  return result;
}

AttitudeSample sample_from(const geoloc_attitude& attitude) {
  AttitudeSample sample;
  sample.time = vehicle_time(attitude.time_ns, "attitude.time_ns");
  sample.angles = {finite(attitude.roll_rad, "attitude.roll_rad"),
                   finite(attitude.pitch_rad, "attitude.pitch_rad"),
                   finite(attitude.yaw_rad, "attitude.yaw_rad")};
  if (attitude.has_rates != 0)
    sample.rates_in_body_radps = vector3(attitude.rates_in_body_radps, "attitude.rates_in_body_radps");
  return sample;
}

PositionSample sample_from(const geoloc_position& position) {
  PositionSample sample;
  sample.time = vehicle_time(position.time_ns, "position.time_ns");
  sample.position = {finite(position.latitude_deg, "position.latitude_deg"),
                     finite(position.longitude_deg, "position.longitude_deg")};
  sample.height_above_home_m = finite(position.height_above_home_m, "position.height_above_home_m");
  if (position.has_height_msl != 0)
    sample.height_msl_m = finite(position.height_msl_m, "position.height_msl_m");
  sample.sigma_horizontal_m = unless_zero(position.sigma_horizontal_m, "position.sigma_horizontal_m");
  if (position.has_velocity != 0)
    sample.velocity_in_enu = vector3(position.velocity_in_enu_mps, "position.velocity_in_enu_mps");
  return sample;
}

GimbalSample sample_from(const geoloc_gimbal& gimbal) {
  const double(&wxyz)[4] = gimbal.level_from_gimbal_wxyz;
  for (const double value : wxyz) finite(value, "gimbal.level_from_gimbal_wxyz");
  if (std::all_of(wxyz, wxyz + 4, [](double value) { return value == 0.0; }))
    throw BadArgument("gimbal.level_from_gimbal_wxyz is no rotation");  // as a structure begins
  GimbalSample sample;
  sample.time = vehicle_time(gimbal.time_ns, "gimbal.time_ns");
  sample.level_from_gimbal = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  sample.yaw = one_of_two<GimbalYaw>(gimbal.yaw, "gimbal.yaw");
  if (gimbal.tells_hold != 0) sample.holds_direction = gimbal.holds_direction != 0;
  return sample;
}

FieldOfViewSample sample_from(const geoloc_field_of_view& field_of_view) {
  return {vehicle_time(field_of_view.time_ns, "field_of_view.time_ns"),
          unless_zero(field_of_view.horizontal_rad, "field_of_view.horizontal_rad"),
          unless_zero(field_of_view.vertical_rad, "field_of_view.vertical_rad")};
}

RangeSample sample_from(const geoloc_range& range) {
  return {vehicle_time(range.time_ns, "range.time_ns"), at_least_zero(range.distance_m, "range.distance_m")};
}

void fill(FrameDetections& frame, const geoloc_frame& given) {
  if (given.detection_count > GEOLOC_MOST_DETECTIONS)
    throw BadArgument("frame.detection_count is more than GEOLOC_MOST_DETECTIONS");
  if (given.detection_count > 0) required(given.detections, "frame.detections");
  frame.captured_at = vehicle_time(given.captured_at_ns, "frame.captured_at_ns");
  frame.captured_at_host = HostTime{duration(given.captured_at_utc_ns, "frame.captured_at_utc_ns")};
  frame.time_sigma_s = at_least_zero(given.time_sigma_s, "frame.time_sigma_s");
  if (frame.time_sigma_s > kLargestTimeSigma_s) throw BadArgument("frame.time_sigma_s is more than 60");
  frame.detections.clear();
  for (std::size_t i = 0; i < given.detection_count; ++i)
    frame.detections.push_back(detection_from(given.detections[i]));
  frame.mount.reset();
  if (given.has_mount != 0) frame.mount = mount_from(given.mount);
  frame.focal_px.reset();
  const double fx_px = finite(given.focal_px[0], "frame.focal_px");
  const double fy_px = finite(given.focal_px[1], "frame.focal_px");
  if (fx_px != 0.0 || fy_px != 0.0) frame.focal_px = Eigen::Vector2d(fx_px, fy_px);
}

FrameWait wait_from(int32_t wait) {
  return one_of_two<FrameWait>(wait, "wait");
}

}  // namespace geoloc::c
