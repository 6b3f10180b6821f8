// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/camera_receiver.hpp"
#include "geoloc/io/mavlink/clock_mapping.hpp"
#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/io/mavlink/gimbal_receiver.hpp"
#include "geoloc/io/mavlink/link_pace.hpp"
#include "geoloc/io/mavlink/link_sender.hpp"
#include "geoloc/io/mavlink/link_status.hpp"
#include "geoloc/io/mavlink/mavlink_config.hpp"
#include "geoloc/io/mavlink/messages.hpp"
#include "geoloc/io/mavlink/position_gate.hpp"
#include "geoloc/io/mavlink/rate_meter.hpp"
#include "geoloc/io/mavlink/stream_requests.hpp"
#include "geoloc/io/mavlink/telemetry_sink.hpp"
#include "geoloc/io/mavlink/vehicle_choice.hpp"
#include "geoloc/state/boot_clock_monitor.hpp"

namespace geoloc::io {

/// One vehicle on a MAVLink connection: received bytes go in; its telemetry and clock come out, and the
/// requests to send to keep them coming. It does no input or output and reads no clock.
///
/// The vehicle is the autopilot that sends state (VehicleChoice); nothing from others reaches the sink. What
/// consume() delivers depends only on the bytes and their times,
/// never on poll(): the recorded frames with their times give the same samples and the same clock map.
class VehicleLink {
 public:
  using Send = LinkSender::Send;

  /// `has_gimbal`: a gimbal's angles are asked for. They are delivered either way. Throws
  /// std::invalid_argument naming every problem.
  explicit VehicleLink(const MavlinkConfig& config, bool has_gimbal = false);

  /// Takes bytes as received, in pieces of any size; `received_at` is in whole microseconds, as in
  /// recordings. True if they completed a frame of the vehicle: replies go to their sender.
  bool consume(HostTime received_at, const std::uint8_t* data, std::size_t size, TelemetrySink& sink);

  /// To be called often (10 times a second or more): sends what is due. Silent until a vehicle is known.
  void poll(HostTime now, const Send& send);

  /// Queues a line for the people at the ground stations (STATUSTEXT), at most two per second.
  void say(const std::string& text) { sender_.say(text); }

  const VehicleClockMap& clock() const { return clock_; }
  LinkStatus status(HostTime now) const;
  /// GIMBAL_DEVICE_ERROR_FLAGS of the camera's gimbal, as it told last.
  std::uint32_t gimbal_failures() const { return gimbal_.failure_flags(); }

 private:
  /// Where and when a message came in.
  struct Arrival {
    HostTime at;
    TelemetrySink& sink;
  };

  bool take(const Frame& frame, const Arrival& arrival);
  void take_of_component(const Frame& frame, const Message& message, const Arrival& arrival);
  void begin_with_vehicle(const Arrival& arrival);
  bool accept_stamp(VehicleTime stamp, const Arrival& arrival);
  bool accept_early_stamp(VehicleTime stamp, const Arrival& arrival);
  void tell_of_clock_step(std::uint64_t steps_before, const Arrival& arrival);

  void handle(const NotDecoded&, const Arrival&) {}
  void handle(const RefusedValues&, const Arrival&) { ++counts_.refused_values; }
  void handle(const Heartbeat&, const Arrival&) {}
  void handle(const AttitudeMessage& message, const Arrival& arrival);
  void handle(const PositionSample& message, const Arrival& arrival);
  void handle(const RangeMessage& message, const Arrival& arrival);
  void handle(const GimbalMessage& message, const Arrival& arrival) {
    take_gimbal(choice_.vehicle()->component, message, arrival);
  }
  void handle(const FieldOfViewMessage& message, const Arrival& arrival) {
    take_field_of_view(choice_.vehicle()->component, message, arrival);
  }
  void handle(const ZoomLevel& message, const Arrival&) { camera_.note(message); }
  void handle(const GnssStatus& message, const Arrival& arrival) { gate_.observe(message, arrival.at); }
  void handle(const EstimatorStatus& message, const Arrival& arrival) { gate_.observe(message, arrival.at); }
  void handle(const Timesync& message, const Arrival& arrival);
  void handle(const SystemTime& message, const Arrival& arrival) { accept_stamp(message.time, arrival); }
  void handle(const CommandAck& message, const Arrival& arrival);

  void take_gimbal(std::uint8_t component, const GimbalMessage& message, const Arrival& arrival);
  void take_field_of_view(std::uint8_t component, const FieldOfViewMessage& message, const Arrival& arrival);

  void ask_anew(HostTime now);
  void want_streams(HostTime now);
  LinkPace::Heard heard(HostTime now) const;
  MavAddress self() const;
  bool is_for_us(MavAddress target) const;
  bool is_of_vehicle(MavAddress sender) const;
  bool is_alive(HostTime now) const;

  MavlinkConfig config_;
  bool has_gimbal_;
  FrameParser parser_;
  VehicleChoice choice_;
  BootClockMonitor boot_clock_;
  VehicleClockMap clock_;
  PositionGate gate_;
  RateMeter attitude_meter_;
  RateMeter position_meter_;
  std::optional<HostTime> last_attitude_;
  std::optional<HostTime> last_euler_attitude_;
  std::optional<HostTime> last_position_;
  std::optional<PositionRefusal> last_refusal_;  // of a position, after the last one that was delivered
  std::optional<HostTime> last_stamped_range_;
  GimbalReceiver gimbal_;
  CameraReceiver camera_;
  bool has_delivered_ = false;  // a sample of the present vehicle
  HostTime last_heard_{};
  bool is_v2_ = false;
  TelemetryCounts counts_;

  // What poll() sends. None of it may reach what consume() delivers.
  LinkPace pace_;
  StreamRequests requests_;
  LinkSender sender_;
};

}  // namespace geoloc::io
