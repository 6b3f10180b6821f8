// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geoloc/camera/camera.hpp"
#include "geoloc/io/sei/video_telemetry.hpp"
#include "geoloc/sim/live/flight_clock.hpp"
#include "geoloc/sim/live/recorded_streams.hpp"

namespace geoloc::sim {

/// What a camera on the vehicle writes into its frames: the last that it has heard of the autopilot, and how
/// old that is. Where the flight is flown X times as fast, ages are an X-th and velocities X times what they
/// were; while the flight clock waits, the pose stands still and is new.
class CameraTelemetry {
 public:
  /// Flight and clock must outlive it.
  CameraTelemetry(const Flight& flight, const FlightClock& clock, const CameraIntrinsics& camera);

  /// The telemetry of the frame that is stamped so.
  io::VideoTelemetry at(HostTime stamp) const;

 private:
  const Flight& flight_;
  const FlightClock& clock_;
  double half_width_;  // of the picture at unit distance, where the camera does not zoom
  std::optional<RecordedStream> attitudes_;
  std::optional<RecordedStream> positions_;
  std::optional<RecordedStream> gimbal_;
};

}  // namespace geoloc::sim
