// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "geoloc/io/mavlink/component_clock.hpp"
#include "geoloc/io/mavlink/link_status.hpp"
#include "geoloc/io/mavlink/mavlink_config.hpp"
#include "geoloc/io/mavlink/messages.hpp"
#include "geoloc/io/mavlink/rate_meter.hpp"
#include "geoloc/io/mavlink/stream_requests.hpp"
#include "geoloc/state/samples.hpp"

namespace geoloc::io {

/// Takes the fields of view of the vehicle's camera, on the vehicle's clock, and knows what to ask it for. A
/// camera's number is its component's, 100 to 105, or 1 to 6 of those that the autopilot drives.
class CameraReceiver {
 public:
  explicit CameraReceiver(const MavlinkConfig& config)
      : number_(config.zoom_camera), rate_hz_(config.zoom_rate_hz) {}

  /// The sample of a message of the vehicle's component. nullopt, and counted, where it is of another camera
  /// or its time cannot be. A camera that is a component of its own goes before one of the autopilot's, which
  /// mostly tells what a parameter says: that is taken once it has changed.
  std::optional<FieldOfViewSample> take(std::uint8_t component, const FieldOfViewMessage& message,
                                        HostTime received_at, const VehicleClock& clock,
                                        TelemetryCounts& counts);

  void note(const ZoomLevel& level);

  /// A message of a component of the vehicle, of which requests are made where it is the camera.
  void hear(std::uint8_t component, bool is_camera, HostTime received_at);
  void on_message(std::uint8_t component, std::uint32_t message_id, HostTime received_at);
  void on_answer(std::uint8_t component, std::uint8_t result, HostTime received_at);

  /// The request to send now, if there is one, and to which component.
  std::optional<StreamRequest> next_request(HostTime now) { return requests_.next(now); }
  std::uint8_t asked_component() const { return asked_.value_or(0); }

  /// It rebooted, or was out of reach.
  void ask_anew(HostTime now) { requests_.restart(now); }

  /// What was learnt of another vehicle does not hold for this one.
  void restart();

  /// Writes what a status tells of it.
  void report(HostTime now, LinkStatus& status) const;

 private:
  bool is_it(std::uint8_t number) const;
  bool has_changed(const FieldOfViewSample& sample);
  void note_view(const FieldOfViewSample& sample);

  int number_;  // the only camera that may be it; 0: any
  double rate_hz_;
  std::optional<std::uint8_t> camera_;
  std::optional<std::uint8_t> asked_;  // component
  StreamRequests requests_;
  ComponentClock clock_;
  std::optional<double> first_angle_rad_;
  bool has_changed_ = false;
  std::optional<FieldOfViewSample> widest_view_;
  std::optional<HostTime> last_;
  RateMeter meter_;
  std::optional<double> first_level_percent_;
  bool has_level_changed_ = false;
};

}  // namespace geoloc::io
