// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "geoloc/io/mavlink/commands.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc::io {

/// What a receiver claims of its position; GPS_FIX_TYPE as MAVLink numbers it.
struct GnssClaim {
  std::uint8_t fix_type = 3;
  std::optional<double> sigma_horizontal_m;
  std::optional<double> sigma_height_m;
};

/// Writes the messages in which an autopilot tells its state, for recordings that are made of other sources.
/// Each call uses one sequence number. Times are rounded to the milliseconds that the messages have.
class StateWriter {
 public:
  /// `system`: the vehicle's id, 1 to 255.
  explicit StateWriter(std::uint8_t system = 1) : system_(system) {}

  OutgoingFrame heartbeat();

  /// ATTITUDE; rates that the sample does not tell are NaN.
  OutgoingFrame attitude(const AttitudeSample& sample);

  /// GLOBAL_POSITION_INT. A height above sea level that the sample does not tell is that above home, and a
  /// velocity is zero.
  OutgoingFrame position(const PositionSample& sample);

  /// GPS_RAW_INT of the same place.
  OutgoingFrame gnss(const PositionSample& sample, const GnssClaim& claim);

  /// GIMBAL_DEVICE_ATTITUDE_STATUS of the first gimbal or, where the sample does not tell whether it holds a
  /// direction, MOUNT_ORIENTATION, which does not either.
  OutgoingFrame gimbal(const GimbalSample& sample);

  /// CAMERA_FOV_STATUS of a camera that is a component of its own, and has the vehicle's clock.
  OutgoingFrame field_of_view(const FieldOfViewSample& sample);

 private:
  OutgoingFrame gimbal_device(const GimbalSample& sample, bool holds_direction);
  OutgoingFrame mount_orientation(const GimbalSample& sample);

  std::uint8_t system_;
  std::uint8_t sequence_ = 0;
  std::uint8_t camera_sequence_ = 0;
};

}  // namespace geoloc::io
