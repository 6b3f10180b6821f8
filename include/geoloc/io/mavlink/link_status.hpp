// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/clock_mapping.hpp"
#include "geoloc/io/mavlink/frame.hpp"
#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/io/mavlink/gimbal_choice.hpp"
#include "geoloc/io/mavlink/position_gate.hpp"
#include "geoloc/io/mavlink/stream_requests.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc::io {

/// What became of the vehicle's messages.
struct TelemetryCounts {
  std::uint64_t vehicle_frames = 0;
  std::uint64_t foreign_frames =
      0;  ///< of other senders, its gimbal among them, and all before a vehicle was heard
  std::uint64_t attitudes = 0;         ///< delivered
  std::uint64_t positions = 0;         ///< delivered
  std::uint64_t ranges = 0;            ///< of a rangefinder that looks down: delivered
  std::uint64_t gimbals = 0;           ///< of the camera's gimbal: delivered
  std::uint64_t other_gimbals = 0;     ///< of another one, or what is told better by another message
  std::uint64_t fields_of_view = 0;    ///< of the camera that counts: delivered
  std::uint64_t other_cameras = 0;     ///< fields of view of another one
  std::uint64_t second_attitudes = 0;  ///< ATTITUDE_QUATERNION in addition to ATTITUDE: ignored
  std::uint64_t no_fix_positions = 0;  ///< of a vehicle that did not know its position: ignored
  std::uint64_t refused_values = 0;    ///< not finite, or out of range
  std::uint64_t suspect_stamps = 0;    ///< far from the previous ones
  std::uint64_t reboots = 0;
  std::uint64_t foreign_timesyncs = 0;  ///< requests, and answers to others
};

/// A VehicleLink at one moment.
struct LinkStatus {
  std::optional<MavAddress> vehicle;  ///< nullopt until an autopilot was heard
  /// Another autopilot's system that was heard just now; mavlink.system_id would make it the vehicle.
  std::optional<std::uint8_t> other_system;
  bool is_v2 = false;                               ///< the vehicle's last frame
  std::optional<std::uint8_t> fix_type;             ///< GPS_FIX_TYPE, where the vehicle sends it
  std::optional<PositionRefusal> position_refusal;  ///< of the last position, or of any that would come now
  bool has_gnss_glitch = false;                     ///< as the vehicle's estimator says
  double attitude_rate_hz = 0.0;                    ///< delivered, over the last three seconds
  double position_rate_hz = 0.0;
  std::optional<Duration> since_attitude;  ///< nullopt before the first
  std::optional<Duration> since_position;
  std::optional<Duration> since_gimbal;
  double gimbal_rate_hz = 0.0;
  std::optional<GimbalDevice> gimbal;      ///< the one that is listened to
  GimbalSource gimbal_source{};            ///< what it tells its angles by
  std::uint32_t gimbal_failure_flags = 0;  ///< GIMBAL_DEVICE_ERROR_FLAGS, of its last message
  std::optional<Duration> since_field_of_view;
  double field_of_view_rate_hz = 0.0;
  std::optional<FieldOfViewSample> widest_view;  ///< that the camera has told, whether it is used or not
  bool has_zoom_changed = false;                 ///< of the camera, as its field of view tells
  bool zooms_untold = false;  ///< the camera says that it zooms, and never its field of view
  VehicleClockMap::Source clock_source = VehicleClockMap::Source::kNone;
  std::optional<Duration> clock_error_bound;  ///< nullopt where only arrivals are known
  std::uint64_t lost_frames = 0;              ///< of the vehicle, by its sequence numbers

  FrameCounts frames;
  TelemetryCounts telemetry;
  VehicleClockMap::Counts clock;
  StreamRequests::Counts requests;
};

}  // namespace geoloc::io
