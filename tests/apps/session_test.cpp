// SPDX-License-Identifier: Apache-2.0
#include "common/session.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "common/link_message.hpp"
#include "io/mavlink/test_frames.hpp"

namespace geoloc::apps {
namespace {

using namespace std::chrono_literals;
using io::testing::Bytes;
using io::testing::FrameFactory;

constexpr HostTime kStart{std::chrono::seconds{1'795'300'000}};
constexpr double kLatitude_deg = -22.906, kLongitude_deg = -43.133;

/// A vehicle that hovers, its clock 0 at kStart, and a camera with empty frames. Others may speak in between.
class Hover {
  EstimationConfig config_;

 public:
  void hear(const Bytes& bytes) { session.add_telemetry(now_, bytes.data(), bytes.size()); }

  /// Telemetry at 10 Hz and a frame every half second, 200 ms old.
  void fly(Duration duration) {
    for (const HostTime end = now_ + duration; now_ < end; now_ += 100ms) {
      const VehicleTime stamp{now_ - kStart};
      if (seconds_begun_ <= seconds(now_ - kStart)) {
        hear(vehicle_.heartbeat());
        ++seconds_begun_;
      }
      hear(vehicle_.attitude(stamp));
      hear(vehicle_.position(stamp, kLatitude_deg, kLongitude_deg));
      if ((now_ - kStart) % 500ms == 0ms) located_ += session.process({now_ - 200ms, {}, 0.0}) ? 1 : 0;
    }
  }

  /// So many frames were located since the last call.
  int take_located() { return std::exchange(located_, 0); }
  LinkMessage message() const {
    return link_message(session.link().status(now_), session.geolocator().state());
  }

  Session session{config_};

 private:
  HostTime now_ = kStart + 1s;
  int seconds_begun_ = 0;
  int located_ = 0;
  FrameFactory vehicle_{{1, 1}};
};

TEST(Session, LocatesFramesThoughAnotherSystemsHeartbeatCameFirst) {
  Hover hover;
  hover.hear(FrameFactory({7, 1}).heartbeat());
  hover.fly(5s);
  EXPECT_EQ(hover.take_located(), 9) << "all but that of before the first state";
  EXPECT_EQ(hover.message().text, "vehicle 1: telemetry comes");
}

TEST(Session, LocatesFramesThoughOneFalsePositionCameFirst) {
  Hover hover;
  FrameFactory liar({1, 1});
  hover.hear(liar.heartbeat());
  hover.hear(liar.position(VehicleTime{999ms}, kLatitude_deg + 2.0, kLongitude_deg));
  EXPECT_FALSE(hover.message().is_good);
  hover.fly(5s);
  EXPECT_EQ(hover.take_located(), 9);
  EXPECT_TRUE(hover.message().is_good);
}

TEST(Session, BeginsAnewWhereTheMapIsEmptyAndElsewhere) {
  Hover hover;
  FrameFactory liar({1, 1});
  hover.hear(liar.heartbeat());
  for (const Duration stamp : {900ms, 950ms})
    hover.hear(liar.position(VehicleTime{stamp}, kLatitude_deg + 2.0, kLongitude_deg));
  hover.fly(1s);
  EXPECT_EQ(hover.message().text,
            "vehicle 1: its positions are more than 200 km from where the run began: a restart begins there; "
            "frames cannot be located");
  hover.fly(5s);
  EXPECT_GE(hover.take_located(), 7);
  EXPECT_TRUE(hover.message().is_good) << hover.message().text;
}

TEST(Session, NamesTheOtherSystemWhereTheVehicleSendsNoState) {
  Hover hover;
  EXPECT_EQ(hover.message().text, "waiting for a vehicle: no MAVLink heartbeat of an autopilot yet");
  hover.hear(FrameFactory({7, 1}).heartbeat());
  hover.hear(FrameFactory({3, 1}).heartbeat());
  EXPECT_EQ(
      hover.message().text,
      "vehicle 7: no attitude comes; frames cannot be located; system 3 is heard, too: mavlink.system_id "
      "3 would make it the vehicle");
}

}  // namespace
}  // namespace geoloc::apps
