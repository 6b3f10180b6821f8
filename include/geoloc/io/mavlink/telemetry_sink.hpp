// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "geoloc/geometry/time.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc::io {

/// Where a VehicleLink delivers to.
class TelemetrySink {
 public:
  virtual ~TelemetrySink() = default;

  /// Checked values of the selected vehicle. Their times may repeat or run back a little, as packets do.
  virtual void on_attitude(const AttitudeSample& sample) = 0;
  virtual void on_position(const PositionSample& sample) = 0;

  /// A rangefinder's reading, which most sinks have no use for.
  virtual void on_range(const RangeSample&) {}

  /// A gimbal's angles, for cameras that are on one.
  virtual void on_gimbal(const GimbalSample&) {}

  /// A camera's field of view, where it tells it.
  virtual void on_field_of_view(const FieldOfViewSample&) {}

  /// The vehicle's clock was reset: times before and after it cannot be compared.
  virtual void on_reboot() = 0;

  /// The samples so far were of a system that turned out not to be the vehicle: what was made of them is
  /// void.
  virtual void on_other_vehicle() {}

  /// The vehicle's clock stepped against the host's by `change` (vehicle - host), or the link's delay did
  /// where nothing tells the two apart: samples on both sides of it cannot be interpolated.
  virtual void on_clock_step(Duration change) = 0;

  /// Every frame of the link from any sender, before the call for its content. This is what a recording
  /// keeps.
  virtual void on_frame(HostTime received_at, const std::uint8_t* frame, std::size_t size) = 0;
};

}  // namespace geoloc::io
