// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/camera_clock.hpp"

#include <algorithm>

namespace geoloc::io {
namespace {

Duration difference(HostTime host, CameraTime camera) {
  return host.time_since_epoch() - camera.time_since_epoch();
}

}  // namespace

/// A stream that stalls is late, too, but its clock neither steps back nor comes from the future.
bool CameraClock::is_set_anew(CameraTime made_at, HostTime received_at) const {
  const Duration delay = difference(received_at, made_at) - *host_minus_camera_;
  return made_at < newest_ - kLargestStepBack || delay < -kLargestLead;
}

HostTime CameraClock::to_host(CameraTime made_at, HostTime received_at) {
  if (!host_minus_camera_ || is_set_anew(made_at, received_at)) {
    const Duration delay = difference(received_at, made_at);
    const bool is_right = delay >= -kLargestLead && delay <= kLargestDelay;
    host_minus_camera_ = is_right ? Duration{} : delay;
    newest_ = made_at;
  }
  newest_ = std::max(newest_, made_at);
  return HostTime{
      std::chrono::floor<std::chrono::microseconds>(made_at.time_since_epoch() + *host_minus_camera_)};
}

}  // namespace geoloc::io
