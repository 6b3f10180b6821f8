// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/camera_messages.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "geoloc/camera/field_of_view.hpp"
#include "geoloc/geometry/angles.hpp"
#include "pack.hpp"

namespace geoloc::io {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

std::int32_t scaled(double value, double scale) {
  constexpr double kLimit = std::numeric_limits<std::int32_t>::max() - 1;
  const double result = std::round(value * scale);
  if (!(std::abs(result) <= kLimit))
    return std::numeric_limits<std::int32_t>::max();  // the protocol's value for unknown
  return static_cast<std::int32_t>(result);
}

std::uint32_t boot_ms(VehicleTime time) {
  return static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count());
}

float field_of_view_deg(int size_px, double focal_length_px) {
  return static_cast<float>(angle_of_view_rad(size_px, focal_length_px) * kDegPerRad);
}

}  // namespace

OutgoingFrame CameraWriter::heartbeat(MavAddress self) {
  return pack_heartbeat(self, sequence_++, true, MAV_TYPE_CAMERA);
}

OutgoingFrame CameraWriter::command_ack(MavAddress self, MavAddress to, std::uint16_t command,
                                        std::uint8_t result) {
  mavlink_command_ack_t fields{};
  fields.command = command;
  fields.result = result;
  fields.target_system = to.system;
  fields.target_component = to.component;
  return pack(self, sequence_++, true, mavlink_msg_command_ack_encode_status, fields);
}

OutgoingFrame CameraWriter::information(MavAddress self, VehicleTime time, const CameraIntrinsics& image) {
  mavlink_camera_information_t fields{};
  fields.time_boot_ms = boot_ms(time);
  std::memcpy(fields.vendor_name, "geoloc", sizeof "geoloc");
  std::memcpy(fields.model_name, "geoloc", sizeof "geoloc");
  fields.focal_length = kUnknown;
  fields.sensor_size_h = kUnknown;
  fields.sensor_size_v = kUnknown;
  fields.resolution_h = static_cast<std::uint16_t>(image.width_px);
  fields.resolution_v = static_cast<std::uint16_t>(image.height_px);
  fields.flags = CAMERA_CAP_FLAGS_HAS_TRACKING_POINT | CAMERA_CAP_FLAGS_HAS_TRACKING_GEO_STATUS;
  return pack(self, sequence_++, true, mavlink_msg_camera_information_encode_status, fields);
}

OutgoingFrame CameraWriter::field_of_view(MavAddress self, const CameraView& view,
                                          const CameraIntrinsics& image) {
  constexpr std::int32_t kAtInfinity = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kNotKnown = std::numeric_limits<std::int32_t>::max();
  const auto altitude = [&](const std::optional<double>& height_msl_m) {
    return height_msl_m ? scaled(*height_msl_m, 1e3) : kNotKnown;
  };
  mavlink_camera_fov_status_t fields{};
  fields.time_boot_ms = boot_ms(view.time);
  fields.lat_camera = scaled(view.camera.latitude_deg, 1e7);
  fields.lon_camera = scaled(view.camera.longitude_deg, 1e7);
  fields.alt_camera = altitude(view.camera_height_msl_m);
  fields.lat_image = view.image_centre ? scaled(view.image_centre->latitude_deg, 1e7) : kAtInfinity;
  fields.lon_image = view.image_centre ? scaled(view.image_centre->longitude_deg, 1e7) : kAtInfinity;
  fields.alt_image = view.image_centre ? altitude(view.ground_height_msl_m) : kAtInfinity;
  const Eigen::Vector4f xyzw = view.ned_from_camera.coeffs().cast<float>();
  const Eigen::Vector4f wxyz(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  std::memcpy(fields.q, wxyz.data(), sizeof fields.q);
  const Eigen::Vector2d focal_px = view.focal_px.value_or(Eigen::Vector2d(image.fx_px, image.fy_px));
  fields.hfov = field_of_view_deg(image.width_px, focal_px.x());
  fields.vfov = field_of_view_deg(image.height_px, focal_px.y());
  return pack(self, sequence_++, true, mavlink_msg_camera_fov_status_encode_status, fields);
}

OutgoingFrame CameraWriter::tracking(MavAddress self, const CameraTarget* target) {
  mavlink_camera_tracking_geo_status_t fields{};
  fields.tracking_status = CAMERA_TRACKING_STATUS_FLAGS_IDLE;
  for (float* unknown : {&fields.h_acc, &fields.v_acc, &fields.vel_n, &fields.vel_e, &fields.vel_d,
                         &fields.vel_acc, &fields.dist, &fields.hdg, &fields.hdg_acc})
    *unknown = kUnknown;
  if (target != nullptr) {
    fields.tracking_status =
        target->image_point ? CAMERA_TRACKING_STATUS_FLAGS_ACTIVE
                            : CAMERA_TRACKING_STATUS_FLAGS_ACTIVE | CAMERA_TRACKING_STATUS_FLAGS_COASTING;
    fields.lat = scaled(target->position.latitude_deg, 1e7);
    fields.lon = scaled(target->position.longitude_deg, 1e7);
    fields.alt = target->height_msl_m ? static_cast<float>(*target->height_msl_m) : kUnknown;
    fields.h_acc = static_cast<float>(target->sigma_horizontal_m);
    if (target->sigma_height_m) fields.v_acc = static_cast<float>(*target->sigma_height_m);
    fields.dist = static_cast<float>(target->distance_m);
  }
  return pack(self, sequence_++, true, mavlink_msg_camera_tracking_geo_status_encode_status, fields);
}

}  // namespace geoloc::io
