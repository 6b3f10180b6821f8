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
  const auto stamp = message.has_time ? std::optional(message.sample.time) : std::nullopt;
  const auto time = clock_.to_vehicle(component, stamp, received_at, clock);
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
