// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "io/mavlink/collecting_sink.hpp"
#include "io/mavlink/test_frames.hpp"

namespace geoloc::io::testing {

constexpr HostTime kSwitchedOn{std::chrono::seconds{1'795'300'000}};

/// A vehicle whose clock is 0 at kSwitchedOn, and which tells its attitude ten times a second; other
/// components of it speak in between.
class ComponentLink : public ::testing::Test {
 protected:
  void SetUp() override { begin_anew(); }

  void begin_anew(bool has_gimbal = false) {
    link_ = VehicleLink(config_, has_gimbal);
    sink_ = {};
    flown_ = std::chrono::seconds{1};
    hear(vehicle_.heartbeat(), flown_);
  }

  void hear(const Bytes& frame, Duration after_start) {
    link_.consume(kSwitchedOn + after_start, frame.data(), frame.size(), sink_);
  }

  /// The vehicle alone, until then.
  void fly_until(Duration after_start) {
    for (; flown_ <= after_start; flown_ += kStep) hear(vehicle_.attitude(VehicleTime{flown_}), flown_);
  }

  LinkStatus status(Duration after_start) const { return link_.status(kSwitchedOn + after_start); }
  TelemetryCounts counts() const { return status(Duration::zero()).telemetry; }

  /// The message and the component that are asked for, at any time of half a minute in which `speak` is
  /// called at each step.
  std::set<std::pair<int, int>> asked(const std::function<void(Duration)>& speak = [](Duration) {}) {
    std::set<std::pair<int, int>> found;
    for (int i = 0; i < 300; ++i) {
      const Duration now = std::chrono::seconds{1} + i * kStep;
      fly_until(now);
      speak(now);
      link_.poll(kSwitchedOn + now, [&](const std::uint8_t* frame, std::size_t) {
        if (const auto request = request_in(frame)) found.insert(*request);
      });
    }
    return found;
  }

  /// A replay of a flight with such a component must give what it gave before it was listened to: it teaches
  /// nothing of the vehicle's clock.
  void expect_clock_untaught(const std::function<Bytes(VehicleTime)>& message) {
    VehicleLink without{config_};
    CollectingSink sink;
    const auto both_hear = [&](const Bytes& frame, Duration now) {
      hear(frame, now);
      without.consume(kSwitchedOn + now, frame.data(), frame.size(), sink);
    };
    both_hear(vehicle_.heartbeat(), std::chrono::seconds{1});
    for (int i = 0; i < 100; ++i) {
      const Duration now = std::chrono::seconds{1} + i * kStep;
      both_hear(vehicle_.attitude(VehicleTime{now - std::chrono::milliseconds{30}}), now);
      hear(message(VehicleTime{now}), now);
    }
    for (const int at_s : {2, 7}) {
      const HostTime at = kSwitchedOn + std::chrono::seconds{at_s};
      EXPECT_EQ(link_.clock().to_vehicle(at), without.clock().to_vehicle(at));
    }
  }

  MavlinkConfig config_;
  VehicleLink link_{config_};
  CollectingSink sink_;
  FrameFactory vehicle_{{1, 1}};
  Duration flown_{};

 private:
  static constexpr Duration kStep = std::chrono::milliseconds{100};

  /// The message that a COMMAND_LONG asks for and the component that it asks, in either version of MAVLink.
  static std::optional<std::pair<int, int>> request_in(const std::uint8_t* frame) {
    constexpr std::uint8_t kCommandLong = 76, kTargetComponent = 31;
    const bool is_v2 = frame[0] == 0xFD;
    if (frame[is_v2 ? 7 : 5] != kCommandLong) return std::nullopt;
    const std::uint8_t* const payload = frame + (is_v2 ? 10 : 6);
    float message_id = 0.0F;
    std::memcpy(&message_id, payload, sizeof message_id);
    return std::pair<int, int>{static_cast<int>(message_id), payload[kTargetComponent]};
  }
};

}  // namespace geoloc::io::testing
