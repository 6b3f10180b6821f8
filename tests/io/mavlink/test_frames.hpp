// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/frame.hpp"

namespace geoloc::io::testing {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kArduPilot = 3;
constexpr std::uint8_t kPx4 = 12;
constexpr std::uint8_t kQuadrotor = 2;

/// What the frames of a sender are signed with.
struct Signature {
  std::array<std::uint8_t, 32> key{};
  std::uint8_t link = 0;
  std::uint64_t stamp = 0;  ///< of the next frame; those after it have the following ones
};

/// Whether the generated parser finds one frame in these bytes, signed by the key.
bool is_signed_by(const std::array<std::uint8_t, 32>& key, const Bytes& frame);

/// Frames of one sender, made by the generated encoders, which are independent of the code under test.
class FrameFactory {
 public:
  explicit FrameFactory(MavAddress self, bool use_v2 = true) : self_(self), use_v2_(use_v2) {}

  /// MAVLink 2 frames from now on, but for those of unknown messages and TIMESYNC to a target.
  void sign(const Signature& signature) { signature_ = signature; }

  Bytes heartbeat(std::uint8_t autopilot = kArduPilot, std::uint8_t vehicle_type = kQuadrotor);
  Bytes attitude(VehicleTime time, double roll_rad = 0.0, double pitch_rad = 0.0, double yaw_rad = 0.0);
  /// An attitude that is level, with the nose to the north.
  Bytes attitude_quaternion(VehicleTime time);
  Bytes position(VehicleTime time, double latitude_deg, double longitude_deg,
                 double height_above_home_m = 20.0);
  Bytes gnss(std::uint8_t fix_type, double h_acc_m = 0.0);
  /// A reading of a sensor that measures from 0.2 m to 40 m.
  Bytes distance_sensor(VehicleTime time, double distance_m, std::uint8_t orientation = 25,
                        std::uint8_t signal_quality = 0);
  Bytes rangefinder(double distance_m);
  /// GIMBAL_DEVICE_ATTITUDE_STATUS of a gimbal pitched so, its yaw 0 from what the flags say.
  Bytes gimbal_device(VehicleTime time, double pitch_rad, std::uint16_t flags, std::uint8_t device_id = 0,
                      std::uint32_t failure_flags = 0);
  Bytes mount_orientation(VehicleTime time, double pitch_deg);
  Bytes mount_status(double pitch_deg);
  /// CAMERA_FOV_STATUS; nothing is told of where it looks.
  Bytes field_of_view(VehicleTime time, float horizontal_deg, float vertical_deg, std::uint8_t device_id = 0);
  /// CAMERA_SETTINGS.
  Bytes zoom_level(float percent);
  Bytes ekf_status(std::uint16_t flags);
  Bytes estimator_status(std::uint16_t flags, float pos_horiz_accuracy_m = 0.0F);
  Bytes system_time(VehicleTime time);
  Bytes timesync(std::int64_t tc1, std::int64_t ts1);
  /// A TIMESYNC of later dialects, which state the receiver.
  Bytes timesync_to(MavAddress target, std::int64_t tc1, std::int64_t ts1);
  Bytes command_ack(std::uint16_t command, std::uint8_t result, MavAddress target = {});
  Bytes command_long(std::uint16_t command, MavAddress target, float parameter1, float parameter2 = 0.0F);
  /// A message that no dialect knows: the checksum is right for a seed of 0.
  Bytes unknown(std::uint8_t payload_size, std::uint8_t fill);

 private:
  template <typename Encode, typename Fields>
  Bytes pack(Encode encode, const Fields& fields);

  MavAddress self_;
  bool use_v2_;
  std::optional<Signature> signature_;
  std::uint8_t sequence_ = 0;
};

inline Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace geoloc::io::testing
