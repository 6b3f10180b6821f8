// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "geoloc/io/mavlink/component_clock.hpp"
#include "geoloc/io/mavlink/gimbal_choice.hpp"
#include "geoloc/io/mavlink/link_status.hpp"
#include "geoloc/io/mavlink/messages.hpp"
#include "geoloc/io/mavlink/rate_meter.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc::io {

/// Takes the angles of the camera's gimbal, on the vehicle's clock, and knows how they come.
class GimbalReceiver {
 public:
  /// `number`: the only device that may be it (GimbalDevice::number()); 0: any.
  explicit GimbalReceiver(int number) : choice_(number) {}

  /// The sample of a message of the vehicle's component. nullopt, and counted, where it is of another gimbal
  /// or its time cannot be.
  std::optional<GimbalSample> take(std::uint8_t component, const GimbalMessage& message, HostTime received_at,
                                   const VehicleClock& clock, TelemetryCounts& counts);

  /// What was learnt of another vehicle does not hold for this one.
  void restart();

  /// GIMBAL_DEVICE_ERROR_FLAGS, as it told last.
  std::uint32_t failure_flags() const { return failure_flags_; }

  /// Writes what a status tells of it.
  void report(HostTime now, LinkStatus& status) const;

 private:
  GimbalChoice choice_;
  ComponentClock clock_;
  std::optional<HostTime> last_;
  RateMeter meter_;
  std::uint32_t failure_flags_ = 0;
};

}  // namespace geoloc::io
