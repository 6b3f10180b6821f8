// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/link_pace.hpp"

#include <gtest/gtest.h>

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

/// A link with a round trip per second, asked ten times a second.
class LinkPaceTest : public ::testing::Test {
 protected:
  struct Link {
    Duration trip = 5ms;
    double lost_share = 0.0;
    bool obeys = true;
  };

  void run(Duration duration, const Link& link) {
    for (const HostTime end = now_ + duration; now_ < end; now_ += 100ms) {
      if (now_.time_since_epoch() % 1s == 0s) pace_.on_round_trip(link.trip);
      const double frames = pace_.is_fast() ? 10.0 : 2.0;
      lost_ += link.lost_share * frames;
      frames_ += (1.0 - link.lost_share) * frames;
      const bool comes_fast = pace_.is_fast() && link.obeys;
      if (pace_.update(now_,
                       {static_cast<std::uint64_t>(frames_), static_cast<std::uint64_t>(lost_), comes_fast}))
        changes_.push_back(now_);
    }
  }

  LinkPace pace_;
  HostTime now_{1000s};
  std::vector<HostTime> changes_;

 private:
  double frames_ = 0.0, lost_ = 0.0;
};

TEST_F(LinkPaceTest, IsFastOnAQuickLinkAndStaysSo) {
  run(6s, {});
  EXPECT_TRUE(pace_.is_fast());
  run(1h, {});
  EXPECT_EQ(changes_.size(), 1U);
}

TEST_F(LinkPaceTest, IsNeverFastOnASlowLinkOrOneWithoutRoundTrips) {
  run(10min, {80ms});
  EXPECT_TRUE(changes_.empty());
  LinkPace silent;
  for (int i = 0; i < 6000; ++i) EXPECT_FALSE(silent.update(HostTime{i * 100ms}, {}));
}

TEST_F(LinkPaceTest, OneLongTripChangesNothing) {
  run(6s, {});
  pace_.on_round_trip(900ms);
  run(1min, {});
  EXPECT_EQ(changes_.size(), 1U);
}

TEST_F(LinkPaceTest, GivesUpWhereTripsBecomeLong) {
  run(6s, {});
  run(11s, {200ms});
  EXPECT_FALSE(pace_.is_fast());
}

TEST_F(LinkPaceTest, GivesUpWhereMoreIsLostThanBefore) {
  run(6s, {5ms, 0.10});
  EXPECT_TRUE(pace_.is_fast()) << "a router that passes some messages only looks like that";
  run(1min, {5ms, 0.10});
  EXPECT_TRUE(pace_.is_fast());
  run(11s, {5ms, 0.20});
  EXPECT_FALSE(pace_.is_fast());
}

TEST_F(LinkPaceTest, GivesUpARateThatDoesNotCome) {
  run(30s, {5ms, 0.0, false});
  EXPECT_FALSE(pace_.is_fast());
}

TEST_F(LinkPaceTest, TriesAgainAfterPausesThatDouble) {
  run(2h, {5ms, 0.0, false});
  ASSERT_GE(changes_.size(), 12U);
  Duration before{};
  for (std::size_t i = 2; i < changes_.size(); i += 2) {
    const Duration pause = changes_[i] - changes_[i - 1];
    EXPECT_GE(pause, std::min<Duration>(2 * before - 10s, 16min));
    EXPECT_LE(pause, 16min + 10s);
    before = pause;
  }
  EXPECT_GE(changes_[2] - changes_[1], 1min);
}

TEST_F(LinkPaceTest, AnotherVehicleBeginsSlowly) {
  run(6s, {});
  pace_.restart();
  EXPECT_FALSE(pace_.is_fast());
  run(4s, {});
  EXPECT_FALSE(pace_.is_fast());
  run(3s, {});
  EXPECT_TRUE(pace_.is_fast());
}

}  // namespace
}  // namespace geoloc::io
