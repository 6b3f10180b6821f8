// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/gimbal_choice.hpp"

#include <chrono>

#include "mav_numbers.hpp"

namespace geoloc::io {
namespace {

constexpr Duration kSilence = std::chrono::seconds{2};

}  // namespace

bool is_gimbal_component(std::uint8_t component) {
  return component == kFirstGimbalComponent ||
         (component >= kSecondGimbalComponent && component <= kLastGimbalComponent);
}

/// MOUNT_ORIENTATION and MOUNT_STATUS name no device: from an autopilot they are of any.
bool GimbalChoice::takes(std::uint8_t component, const GimbalMessage& message, HostTime received_at) {
  if (component != kAutopilotComponent && !is_gimbal_component(component)) return false;
  const GimbalDevice sender{component, message.device_id};
  const bool may_be_it = number_ == 0 || sender.number() == number_ ||
                         (component == kAutopilotComponent && message.device_id == 0);
  if (!may_be_it) return false;
  const bool is_silent = !device_ || received_at - last_ > kSilence;
  const bool tells_more = message.source > source_;
  if (!is_silent && !tells_more && (message.source != source_ || !(sender == *device_))) return false;
  device_ = sender;
  source_ = message.source;
  last_ = received_at;
  return true;
}

}  // namespace geoloc::io
