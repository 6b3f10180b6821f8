// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/gimbal_receiver.hpp"

#include "mav_numbers.hpp"

namespace geoloc::io {

std::optional<GimbalSample> GimbalReceiver::take(std::uint8_t component, const GimbalMessage& message,
                                                 HostTime received_at, const VehicleClock& clock,
                                                 TelemetryCounts& counts) {
  GimbalChoice choice = choice_;
  if (!choice.takes(component, message, received_at)) {
    ++counts.other_gimbals;
    return std::nullopt;
  }
  const auto time = time_of(component, message, received_at, clock);
  if (!time) {
    ++counts.suspect_stamps;
    return std::nullopt;
  }
  choice_ = choice;
  ++counts.gimbals;
  last_ = received_at;
  meter_.add(received_at);
  failure_flags_ = message.failure_flags;
  GimbalSample sample = message.sample;
  sample.time = *time;
  return sample;
}

/// nullopt where the time cannot be.
std::optional<VehicleTime> GimbalReceiver::time_of(std::uint8_t component, const GimbalMessage& message,
                                                   HostTime received_at, const VehicleClock& clock) {
  if (!message.has_time) return clock.map.to_vehicle(received_at);
  const VehicleTime stamp = message.sample.time;
  if (component != kAutopilotComponent) return time_by_arrival(stamp, received_at, clock.map);
  if (!clock.boot.is_near_newest(stamp) || clock.map.is_early(stamp, received_at)) return std::nullopt;
  return stamp;
}

/// A component of its own has a boot clock of its own, which is known by the arrival of its messages.
std::optional<VehicleTime> GimbalReceiver::time_by_arrival(VehicleTime stamp, HostTime received_at,
                                                           const VehicleClockMap& map) {
  switch (boot_clock_.observe(stamp)) {
    case BootClockMonitor::Verdict::kSuspect:
      return std::nullopt;
    case BootClockMonitor::Verdict::kRebooted:
      clock_.clear();
      break;
    case BootClockMonitor::Verdict::kAdvanced:
      break;
  }
  clock_.add(stamp, received_at);
  const auto offset = clock_.offset();
  if (!offset) return std::nullopt;
  return map.to_vehicle(HostTime{stamp.time_since_epoch() - *offset});
}

void GimbalReceiver::restart() {
  choice_.restart();
  last_.reset();
}

void GimbalReceiver::report(HostTime now, LinkStatus& status) const {
  if (last_) status.since_gimbal = now - *last_;
  status.gimbal_rate_hz = meter_.rate_hz(now);
  status.gimbal = choice_.device();
  status.gimbal_source = choice_.source();
  status.gimbal_failure_flags = failure_flags_;
}

}  // namespace geoloc::io
