// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "geoloc/io/mavlink/frame.hpp"
#include "geoloc/state/samples.hpp"

// What geoloc reads from a vehicle, in the units of the library.
namespace geoloc::io {

struct Heartbeat {
  std::uint8_t vehicle_type = 0;  ///< MAV_TYPE
  std::uint8_t autopilot = 0;     ///< MAV_AUTOPILOT

  /// Not a ground station, camera, gimbal or companion.
  bool is_from_autopilot() const;
  bool is_from_ardupilot() const;
  bool is_from_camera() const;
  bool is_from_px4() const;
};

/// ATTITUDE or ATTITUDE_QUATERNION.
struct AttitudeMessage {
  AttitudeSample sample;
  bool from_quaternion = false;
};

/// DISTANCE_SENSOR that looks down, or RANGEFINDER, which does not say when.
struct RangeMessage {
  std::optional<VehicleTime> time;
  double distance_m = 0.0;
};

/// Which message told a gimbal's angles; a later one tells more.
enum class GimbalSource : std::uint8_t {
  kMountStatus,       ///< MOUNT_STATUS: hundredths of degrees, without a time
  kMountOrientation,  ///< MOUNT_ORIENTATION
  kDeviceStatus       ///< GIMBAL_DEVICE_ATTITUDE_STATUS
};

/// A gimbal's angles.
struct GimbalMessage {
  GimbalSample sample;
  GimbalSource source = GimbalSource::kMountStatus;
  bool has_time = false;            ///< of its sender's boot clock; else the sample's time is nothing
  std::uint8_t device_id = 0;       ///< 1 to 6: of the gimbals that an autopilot drives itself; 0: not stated
  std::uint32_t failure_flags = 0;  ///< GIMBAL_DEVICE_ERROR_FLAGS
};

/// CAMERA_FOV_STATUS: how much a camera shows. What it says of where it looks is not used.
struct FieldOfViewMessage {
  FieldOfViewSample sample;    ///< its time is of the sender's boot clock, or 0: not stated
  std::uint8_t device_id = 0;  ///< 1 to 6: of the cameras that an autopilot drives itself; 0: not stated
};

/// CAMERA_SETTINGS: how far a camera has zoomed in, in percent of a range that nobody tells.
struct ZoomLevel {
  double percent = 0.0;
};

/// GPS_RAW_INT: the first receiver only. Its own position is not used: the autopilot's estimate is better.
struct GnssStatus {
  std::uint8_t fix_type = 0;                 ///< GPS_FIX_TYPE: 3 and more have a position
  std::optional<double> sigma_horizontal_m;  ///< h_acc, where the receiver states it (never in MAVLink 1)
};

/// EKF_STATUS_REPORT (ArduPilot) or ESTIMATOR_STATUS (PX4), which share the bits that matter here.
struct EstimatorStatus {
  std::uint16_t flags = 0;
  bool has_gnss_glitch = false;              ///< the two name it by different bits
  std::optional<double> sigma_horizontal_m;  ///< pos_horiz_accuracy, which ESTIMATOR_STATUS alone has

  bool has_absolute_position() const;
};

/// TIMESYNC: a request has vehicle_ns = 0.
struct Timesync {
  std::int64_t vehicle_ns = 0;    ///< tc1: the answering clock
  std::int64_t requester_ns = 0;  ///< ts1: given back as it came
  MavAddress target;              ///< of an answer, where the sender states it; else 0, 0
};

/// SYSTEM_TIME. Its UNIX time is ignored: it is 0 before GPS time, and has been seen to be centuries off.
struct SystemTime {
  VehicleTime time;
};

struct CommandAck {
  std::uint16_t command = 0;  ///< MAV_CMD
  std::uint8_t result = 0;    ///< MAV_RESULT
  MavAddress target;          ///< whose command it was, where the sender states it; else 0, 0
};

/// COMMAND_LONG: a request to a component.
struct Command {
  std::uint16_t command = 0;  ///< MAV_CMD
  MavAddress target;          ///< a component of 0: all
  std::array<float, 7> parameters{};
};

/// A message that geoloc has no use for.
struct NotDecoded {};

/// A message with impossible values: not finite, or out of range.
struct RefusedValues {};

using Message = std::variant<NotDecoded, RefusedValues, Heartbeat, AttitudeMessage, PositionSample,
                             RangeMessage, GimbalMessage, FieldOfViewMessage, ZoomLevel, GnssStatus,
                             EstimatorStatus, Timesync, SystemTime, CommandAck>;

/// Payloads that MAVLink 2 truncated are padded with zeros. Positions (GLOBAL_POSITION_INT) are passed on as
/// they are: PositionGate judges whether the vehicle knew where it was.
Message decode(const Frame& frame);

/// nullopt for any other message. The parameters are not checked.
std::optional<Command> decode_command(const Frame& frame);

}  // namespace geoloc::io
