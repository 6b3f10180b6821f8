// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/frame.hpp"
#include "geoloc/io/mavlink/messages.hpp"

namespace geoloc::io {

/// A gimbal of a vehicle: its own component, or one of those that the autopilot drives.
struct GimbalDevice {
  std::uint8_t component = 0;
  std::uint8_t device_id = 0;  ///< of the autopilot's

  /// As MAVLink's commands name it: 1 to 6 of the autopilot's, else the component.
  std::uint8_t number() const { return device_id != 0 ? device_id : component; }
  bool operator==(const GimbalDevice& other) const {
    return component == other.component && device_id == other.device_id;
  }
};

/// Which messages tell the angles of the camera's gimbal: those of one device, and of these the message that
/// tells most. A device that has been silent gives way to another, and a message to a lesser one.
class GimbalChoice {
 public:
  /// `number`: the only device that may be it (GimbalDevice::number()); 0: any.
  explicit GimbalChoice(int number) : number_(number) {}

  /// Whether the message of a component of the vehicle is one of them.
  bool takes(std::uint8_t component, const GimbalMessage& message, HostTime received_at);

  const std::optional<GimbalDevice>& device() const { return device_; }
  GimbalSource source() const { return source_; }

  /// What was learnt of another vehicle does not hold.
  void restart() { device_.reset(); }

 private:
  int number_;
  std::optional<GimbalDevice> device_;
  GimbalSource source_ = GimbalSource::kMountStatus;
  HostTime last_{};
};

/// Whether MAVLink reserves the component for a gimbal.
bool is_gimbal_component(std::uint8_t component);

}  // namespace geoloc::io
