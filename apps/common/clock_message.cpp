// SPDX-License-Identifier: Apache-2.0
#include "common/clock_message.hpp"

#include <fmt/format.h>

namespace geoloc::apps {
namespace {

std::string times(std::uint64_t count) {
  return count == 1 ? "" : fmt::format(", the last of {} times", count);
}

std::string vehicle_message(const io::VehicleClockMap& clock) {
  if (clock.counts().steps == 0) return {};
  return fmt::format(
      "the vehicle's clock jumped by {:+.2f} s against this computer's{}: frames of that moment are left out",
      seconds(clock.last_step()), times(clock.counts().steps));
}

std::string camera_message(const Geolocator& geolocator) {
  const auto changes = geolocator.track_counters().latency_changes;
  const auto calibration = geolocator.calibration();
  if (changes == 0 || !calibration) return {};
  return fmt::format(
      "the camera's stamps changed against the vehicle's clock{}: frames are taken {:.2f} s before their "
      "stamps now",
      times(changes), calibration->latency_s());
}

}  // namespace

std::string clock_message(const Session& session) {
  const std::string vehicle = vehicle_message(session.link().clock());
  const std::string camera = camera_message(session.geolocator());
  return vehicle + (vehicle.empty() || camera.empty() ? "" : "\n") + camera;
}

}  // namespace geoloc::apps
