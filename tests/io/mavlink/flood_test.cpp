// SPDX-License-Identifier: Apache-2.0
#include <all/mavlink.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

#include "geoloc/io/mavlink/camera_component.hpp"
#include "geoloc/io/mavlink/link_guard.hpp"
#include "geoloc/io/mavlink/message_table.hpp"
#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "io/mavlink/test_frames.hpp"

// A flight among floods of damaged, forged and repeated messages, as a live link takes them in. Many bytes of
// them by GEOLOC_FLOOD_BYTES: scripts/flood.sh.
namespace geoloc::io {
namespace {

/// AddressSanitizer keeps what was freed, to know when it is used again.
#if defined(__SANITIZE_ADDRESS__)
constexpr double kMostGrown_mb = 300.0;
#else
constexpr double kMostGrown_mb = 2.0;
#endif

using namespace std::chrono_literals;
using testing::Bytes;
using testing::FrameFactory;

constexpr HostTime kFloodBegins{std::chrono::seconds{1'795'300'000}};
constexpr Duration kFlightStep = 20ms;
constexpr std::size_t kBytesPerStep = 4000;
constexpr std::uint16_t kVehiclesPort = 1;

double wanted_bytes() {
  const char* const wanted = std::getenv("GEOLOC_FLOOD_BYTES");
  return wanted != nullptr ? std::atof(wanted) : 1e7;
}

/// What the vehicle does at a time of its clock, which is 0 at kFloodBegins.
double roll_at(VehicleTime time) {
  return 0.2 * std::sin(seconds(time.time_since_epoch()));
}
double latitude_at(VehicleTime time) {
  return 47.0 + 1e-5 * std::sin(0.1 * seconds(time.time_since_epoch()));
}

/// Counts samples, and those that the vehicle has not sent.
class TruthfulSink : public TelemetrySink {
 public:
  void on_attitude(const AttitudeSample& sample) override {
    ++attitudes;
    lies += std::abs(sample.angles.roll_rad - roll_at(sample.time)) < 1e-6 ? 0 : 1;
  }
  void on_position(const PositionSample& sample) override {
    ++positions;
    lies += std::abs(sample.position.latitude_deg - latitude_at(sample.time)) < 1e-6 ? 0 : 1;
  }
  void on_range(const RangeSample&) override { ++lies; }
  void on_reboot() override { ++lies; }
  void on_other_vehicle() override { ++lies; }
  void on_clock_step(Duration) override { ++lies; }
  void on_frame(HostTime, const std::uint8_t*, std::size_t) override {}

  std::size_t attitudes = 0, positions = 0, lies = 0;
};

/// Bytes that a vehicle did not send, or not now.
class Flood {
 public:
  void remember(const Bytes& frame) { heard_[next_heard_++ % heard_.size()] = frame; }

  Bytes next() {
    switch (random_() % 4) {
      case 0:
        return noise();
      case 1:
        return damaged(heard_[random_() % heard_.size()]);
      case 2:
        return forged();
      default:
        return heard_[random_() % heard_.size()];
    }
  }

  std::uint32_t number() { return static_cast<std::uint32_t>(random_()); }

 private:
  std::uint8_t byte() { return static_cast<std::uint8_t>(random_()); }

  Bytes noise() {
    Bytes bytes(1 + random_() % 300);
    for (std::uint8_t& value : bytes) value = random_() % 16 == 0 ? 0xFD : byte();
    return bytes;
  }

  Bytes damaged(Bytes bytes) {
    for (auto left = random_() % 8; left > 0 && !bytes.empty(); --left)
      bytes[random_() % bytes.size()] = byte();
    if (!bytes.empty() && random_() % 2 == 0) bytes.resize(random_() % bytes.size());
    return bytes;
  }

  /// A frame with the right checksum and any content, often in the vehicle's name.
  Bytes forged() {
    constexpr std::array<std::uint32_t, 13> kMessages{0, 2, 24, 30, 31, 33, 76, 77, 111, 132, 173, 193, 230};
    const std::uint32_t id = kMessages[random_() % kMessages.size()];
    const auto spec = message_spec(id);
    mavlink_message_t message{};
    message.msgid = id & 0xFFFFFFU;
    auto* const payload = reinterpret_cast<std::uint8_t*>(message.payload64);
    std::generate_n(payload, spec->full_size,
                    [this] { return random_() % 3 == 0 ? byte() : std::uint8_t{0}; });
    mavlink_status_t status{};
    status.current_tx_seq = byte();
    const std::uint8_t system = random_() % 2 == 0 ? 1 : byte();
    const std::uint8_t component = random_() % 4 != 0 ? 1 : byte();
    mavlink_finalize_message_buffer(&message, system, component, &status, spec->base_size, spec->full_size,
                                    spec->checksum_seed);
    Bytes bytes(MAVLINK_MAX_PACKET_LEN);
    bytes.resize(mavlink_msg_to_send_buffer(bytes.data(), &message));
    return bytes;
  }

  std::mt19937_64 random_{1};
  std::array<Bytes, 256> heard_{};
  std::size_t next_heard_ = 0;
};

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  file >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// A flight, with a flood once the vehicle is known.
class FloodedFlight {
 public:
  FloodedFlight(const MavlinkConfig& config, const std::optional<SigningKey>& key, bool is_from_its_port)
      : link_(config),
        guard_(config, key ? std::optional(LinkSigning(*key, {})) : std::nullopt),
        is_from_its_port_(is_from_its_port) {
    if (key) vehicle_.sign({*key, 0, 37'000'000'000'000});
  }

  void fly(double flood_bytes) {
    for (int step = 0; step < 500 || flooded() < flood_bytes; ++step) {
      say(step);
      const std::size_t end = step < 500 ? 0 : flooded_ + kBytesPerStep;
      while (flooded_ < end) flood();
      link_.poll(now_, [this](const std::uint8_t* frame, std::size_t size) { answer(frame, size); });
      camera_.poll(now_, MavAddress{1, 1}, true, [](const std::uint8_t*, std::size_t) {});
      now_ += kFlightStep;
      if (step == 600) resident_before_mb_ = resident_mb();
    }
  }

  const TruthfulSink& heard() const { return sink_; }
  std::size_t sent() const { return sent_; }
  double flooded() const { return static_cast<double>(flooded_); }
  double grown_mb() const { return resident_mb() - resident_before_mb_; }
  const LinkGuard::Counts& counts() const { return guard_.counts(); }
  LinkStatus status() const { return link_.status(now_); }
  /// Error of the mapped clock.
  double clock_error_s() const {
    const auto mapped = link_.clock().to_vehicle(now_);
    return mapped ? std::abs(seconds(mapped->time_since_epoch() - (now_ - kFloodBegins))) : 1e9;
  }

 private:
  void say(int step) {
    const VehicleTime time{now_ - kFloodBegins};
    if (step % 50 == 0) speak(vehicle_.heartbeat());
    if (step % 5 == 0) {
      speak(vehicle_.attitude(time, roll_at(time)));
      speak(vehicle_.position(time, latitude_at(time), 8.0));
      ++sent_;
    }
  }

  void speak(const Bytes& frame) {
    flood_.remember(frame);
    hear(frame, kVehiclesPort);
  }

  void flood() {
    const Bytes bytes = flood_.next();
    flooded_ += bytes.size() + 1;
    const auto port = static_cast<std::uint16_t>(kVehiclesPort + 1 + flood_.number() % 1000);
    hear(bytes, is_from_its_port_ && flood_.number() % 2 == 0 ? kVehiclesPort : port);
  }

  void hear(const Bytes& bytes, std::uint16_t port) {
    LinkSource source;
    source.port = port;
    guard_.receive(now_, source, bytes.data(), bytes.size(),
                   [this](const std::uint8_t* frame, std::size_t size) {
                     link_.consume(now_, frame, size, sink_);
                     camera_.consume(frame, size);
                   });
  }

  /// To TIMESYNC requests, without delay.
  void answer(const std::uint8_t* frame, std::size_t size) {
    guard_.outgoing(now_, frame, size);
    if (size < 28 || frame[7] != MAVLINK_MSG_ID_TIMESYNC) return;
    std::int64_t requester_ns = 0;
    for (int i = 7; i >= 0; --i) requester_ns = requester_ns << 8 | frame[18 + i];
    speak(vehicle_.timesync((now_ - kFloodBegins).count(), requester_ns));
  }

  VehicleLink link_;
  LinkGuard guard_;
  CameraComponent camera_{105, CameraIntrinsics{}};
  bool is_from_its_port_;
  FrameFactory vehicle_{{1, 1}};
  Flood flood_;
  TruthfulSink sink_;
  HostTime now_ = kFloodBegins + 1s;
  std::size_t sent_ = 0, flooded_ = 0;
  double resident_before_mb_ = 0.0;
};

TEST(Flood, FromOtherPortsMakesNoFalseStateAndHidesNone) {
  FloodedFlight flight({}, std::nullopt, false);
  flight.fly(0.5 * wanted_bytes());
  EXPECT_EQ(flight.heard().lies, 0U);
  EXPECT_EQ(flight.heard().attitudes, flight.sent());
  EXPECT_EQ(flight.heard().positions, flight.sent());
  EXPECT_EQ(flight.status().vehicle, (MavAddress{1, 1}));
  EXPECT_LT(flight.clock_error_s(), 1e-3);
  EXPECT_LT(flight.grown_mb(), kMostGrown_mb);
  EXPECT_GT(static_cast<double>(flight.counts().second_source), 1e-3 * flight.flooded());
}

TEST(Flood, FromTheVehiclesOwnPortMakesNoFalseStateWhereItSigns) {
  SigningKey key{};
  key[7] = 77;
  FloodedFlight flight({}, key, true);
  flight.fly(0.5 * wanted_bytes());
  EXPECT_EQ(flight.heard().lies, 0U);
  // A copy that was cut within its signature takes the missing bytes from the message that follows.
  EXPECT_GE(static_cast<double>(flight.heard().attitudes), 0.98 * static_cast<double>(flight.sent()));
  EXPECT_EQ(flight.status().vehicle, (MavAddress{1, 1}));
  EXPECT_LT(flight.clock_error_s(), 1e-3);
  EXPECT_LT(flight.grown_mb(), kMostGrown_mb);
  EXPECT_GT(static_cast<double>(flight.counts().refused_signatures()), 1e-3 * flight.flooded());
}

}  // namespace
}  // namespace geoloc::io
