// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/io/sei/video_telemetry.hpp"

namespace geoloc::io {

/// Carries times of the camera's clock, which stand in its frames, to the host's. A camera whose clock is
/// right keeps its times; of another one, or of a file, the first frame was made when it came, and the others
/// as much later as the camera says. A clock that is set anew begins anew.
class CameraClock {
 public:
  /// The host's time of a frame's making. Frames in the order in which they came; whole microseconds.
  HostTime to_host(CameraTime made_at, HostTime received_at);

  /// A clock further behind than this is not UTC: no stream takes longer.
  static constexpr Duration kLargestDelay = std::chrono::seconds{3};
  /// Nor is one further ahead than this: its frames would come from the future.
  static constexpr Duration kLargestLead = std::chrono::milliseconds{500};
  /// Frames may change places by less.
  static constexpr Duration kLargestStepBack = std::chrono::seconds{1};

 private:
  bool is_set_anew(CameraTime made_at, HostTime received_at) const;

  std::optional<Duration> host_minus_camera_;
  CameraTime newest_{};
};

}  // namespace geoloc::io
