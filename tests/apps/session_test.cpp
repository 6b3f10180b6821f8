// SPDX-License-Identifier: Apache-2.0
#include "common/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "common/link_message.hpp"
#include "io/mavlink/test_frames.hpp"

namespace geoloc::apps {
namespace {

using namespace std::chrono_literals;
using io::testing::Bytes;
using io::testing::FrameFactory;
using io::testing::operator+;

constexpr HostTime kStart{std::chrono::seconds{1'795'300'000}};
constexpr double kLatitude_deg = -22.906, kLongitude_deg = -43.133;

/// A vehicle that hovers, its clock 0 at kStart, and a camera with empty frames. Others may speak in between.
class Hover {
  EstimationConfig config_;

 public:
  VehicleTime clock() const { return VehicleTime{now_ - kStart}; }

  void hear(const Bytes& bytes) { session.add_telemetry(now_, bytes.data(), bytes.size()); }

  /// Telemetry at 10 Hz and a frame every half second, which is given up after a second.
  void fly(Duration duration) {
    for (const HostTime end = now_ + duration; now_ < end; now_ += 100ms) {
      const VehicleTime stamp = clock();
      if (seconds_begun_ <= seconds(now_ - kStart)) {
        hear(vehicle_.heartbeat());
        ++seconds_begun_;
      }
      hear(vehicle_.attitude(stamp));
      hear(vehicle_.position(stamp, kLatitude_deg, kLongitude_deg));
      if ((now_ - kStart) % 500ms == 0ms) waiting_.push_back(now_ + 50ms);
      while (!waiting_.empty() && (session.is_decided(waiting_.front()) || now_ - waiting_.front() > 1s)) {
        if (session.process({waiting_.front(), {}, 0.0})) note_located();
        waiting_.pop_front();
      }
    }
  }

  /// So many frames were located since the last call.
  int take_located() { return std::exchange(located_, 0); }
  LinkMessage message() const { return link_message(session.link().status(now_), session.geolocator()); }

  Session session{config_};

  /// How far the frames' states were from where the vehicle hovers, level, at most.
  double farthest_m() const { return farthest_m_; }
  double most_tilted_rad() const { return most_tilted_rad_; }

 private:
  void note_located() {
    ++located_;
    const Rigid3d& enu_from_body = session.geolocator().view().vehicle.enu_from_body;
    farthest_m_ = std::max(farthest_m_, enu_from_body.translation.head<2>().norm());
    most_tilted_rad_ =
        std::max(most_tilted_rad_, std::acos(-(enu_from_body.rotation * Eigen::Vector3d::UnitZ()).z()));
  }

  double farthest_m_ = 0.0, most_tilted_rad_ = 0.0;
  HostTime now_ = kStart + 1s;
  int seconds_begun_ = 0;
  int located_ = 0;
  std::deque<HostTime> waiting_;
  FrameFactory vehicle_{{1, 1}};
};

TEST(Session, LocatesFramesThoughAnotherSystemsHeartbeatCameFirst) {
  Hover hover;
  hover.hear(FrameFactory({7, 1}).heartbeat());
  hover.fly(5s);
  EXPECT_EQ(hover.take_located(), 10);
  EXPECT_EQ(hover.message().text, "vehicle 1: telemetry comes");
}

TEST(Session, LocatesFramesThoughOneFalsePositionCameFirst) {
  Hover hover;
  FrameFactory liar({1, 1});
  hover.hear(liar.heartbeat());
  hover.hear(liar.position(VehicleTime{999ms}, kLatitude_deg + 2.0, kLongitude_deg));
  EXPECT_FALSE(hover.message().is_good);
  hover.fly(5s);
  EXPECT_EQ(hover.take_located(), 10);
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

/// Messages that lie, once, in the vehicle's name, on a link that has no others of their kind.
class OneLie : public ::testing::Test {
 protected:
  /// Frames of the minute after it that were not located.
  int lost(const Bytes& lie) {
    hover_.fly(5s);
    EXPECT_EQ(hover_.take_located(), 10);
    hover_.hear(lie);
    hover_.fly(60s);
    return 120 - hover_.take_located();
  }

  Hover hover_;
  FrameFactory liar_{{1, 1}};
};

TEST_F(OneLie, AStampAheadEachFiveSecondsCostsNoFrameAndFoolsNone) {
  for (const Duration ahead : {1000ms, 2500ms, 4900ms}) {
    Hover hover;
    hover.fly(5s);
    hover.take_located();
    for (int i = 0; i < 12; ++i) {
      hover.hear(liar_.attitude(hover.clock() + ahead, 1.0));
      hover.hear(liar_.position(hover.clock() + ahead, kLatitude_deg + 0.01, kLongitude_deg));
      hover.fly(5s);
    }
    EXPECT_EQ(hover.take_located(), 120) << seconds(ahead);
    EXPECT_LT(hover.farthest_m(), 0.1) << seconds(ahead);
    EXPECT_LT(hover.most_tilted_rad(), 1e-3) << seconds(ahead);
    EXPECT_EQ(hover.session.geolocator().state().counters().reboots, 0U);
  }
}

TEST_F(OneLie, AtTheVeryStartAStampAheadCostsSeconds) {
  hover_.hear(liar_.heartbeat());
  hover_.hear(liar_.attitude(hover_.clock() + 4900ms));
  hover_.fly(60s);
  EXPECT_GE(hover_.take_located(), 120 - 16);
}

TEST_F(OneLie, AnEstimatorWithoutPositionCostsSeconds) {
  EXPECT_LE(lost(liar_.ekf_status(0)), 12);
}

TEST_F(OneLie, AReceiverWithoutFixCostsSeconds) {
  EXPECT_LE(lost(liar_.gnss(1)), 12);
}

TEST_F(OneLie, AnAccuracyOfKilometresIsForgotten) {
  EXPECT_EQ(lost(liar_.gnss(3, 4000.0)), 0);
  EXPECT_FALSE(hover_.session.geolocator().view().vehicle.sigma_horizontal_m);
}

TEST(LinkMessage, SaysWhyNoPositionComes) {
  Hover hover;
  FrameFactory receiver({1, 1});
  hover.hear(receiver.heartbeat());
  const auto after = [&](const Bytes& said) {
    for (int i = 0; i < 8; ++i) {
      hover.hear(said);
      hover.fly(500ms);
    }
    return hover.message().text;
  };
  EXPECT_EQ(after(receiver.gnss(1)), "vehicle 1: its GNSS receiver has no fix yet; frames cannot be located");
  EXPECT_EQ(after(receiver.gnss(3)), "vehicle 1: telemetry comes");
  EXPECT_EQ(after(receiver.gnss(2)),
            "vehicle 1: its GNSS receiver has lost its fix; frames cannot be located");
  EXPECT_EQ(after(receiver.gnss(3) + receiver.ekf_status(831 | 32768)),
            "vehicle 1: telemetry comes; its estimator reports a GNSS glitch: the position may be off");
  EXPECT_EQ(
      after(receiver.gnss(3) + receiver.ekf_status(167)),
      "vehicle 1: no position comes any more: its estimator says that it does not know where it is; frames "
      "cannot be located");
}

}  // namespace
}  // namespace geoloc::apps
