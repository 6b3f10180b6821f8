// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/state_messages.hpp"
#include "geoloc/io/sei/video_telemetry.hpp"

namespace geoloc::apps {

/// 1-sigma of a frame's time that its own telemetry tells: from frame to frame, an encoder takes a little
/// longer or shorter until it hands the picture on. What stays the same is a latency, which the estimator
/// learns.
inline constexpr double kToldTimeSigma_s = 0.02;

/// A vehicle that is told of in its video's frames, in an autopilot's messages: what a Session takes and a
/// recording keeps, so that a replay needs nothing else. Each message comes when what it tells was so, which
/// leaves no delay between the vehicle's clock and this one.
class VideoVehicle {
 public:
  using Tell = std::function<void(HostTime at, const std::uint8_t* frame, std::size_t size)>;

  /// `system`: its MAVLink id.
  explicit VideoVehicle(std::uint8_t system) : writer_(system) {}

  /// Tells what is new in a record. Frames come more often than the autopilot tells its state, so most values
  /// repeat; those are left out, as are values older than a second. `made_at`: when the record was made.
  void tell(HostTime made_at, const io::VideoTelemetry& record, const Tell& tell);

 private:
  enum class Kind { kAttitude, kPosition, kGimbal, kFieldOfView };
  struct Due {
    HostTime at;  ///< when what it tells was so
    Kind kind;
  };

  VehicleTime boot_time(HostTime at) const;
  io::OutgoingFrame message(const Due& due, const io::VideoTelemetry& record);
  PositionSample position_sample(HostTime at, const io::VideoTelemetry& record);

  io::StateWriter writer_;
  std::optional<HostTime> booted_at_;  // what its clock counts from
  std::optional<HostTime> heartbeat_at_;
  std::array<std::optional<HostTime>, 3> told_at_;  // the last of each kind
  std::optional<PositionSample> last_position_;
};

}  // namespace geoloc::apps
