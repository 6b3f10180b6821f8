// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/session.hpp"
#include "geoloc/io/mavlink/camera_component.hpp"

namespace geoloc::apps {

/// What the vehicle's network is told of the results, where the configuration asks for it: a camera that
/// tracks objects, and a line of text for each that is confirmed. It runs on the loop's own thread: the
/// link's datagrams are sent without waiting.
class VehicleReports {
 public:
  VehicleReports(const EstimationConfig& config, std::vector<std::string> class_names);

  /// A frame of the link.
  void on_telemetry(const std::uint8_t* frame, std::size_t size);

  /// After each frame that was located.
  void on_frame(Session& session, HostTime captured_at);

  /// To be called often.
  void poll(HostTime now, const Session& session, const io::CameraComponent::Send& send);

 private:
  void announce(const Geolocator& geolocator, io::VehicleLink& link);

  std::optional<io::CameraComponent> camera_;
  bool says_texts_;
  std::vector<std::string> class_names_;
  std::set<std::uint64_t> announced_;  // objects, by id
};

}  // namespace geoloc::apps
