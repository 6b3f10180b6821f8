// SPDX-License-Identifier: Apache-2.0
#include "tracking/recent_looks.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "calibration/noise.hpp"
#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

VehicleTime at_s(double time_s) {
  return VehicleTime{from_seconds(time_s)};
}

/// Two looks a second at one object, which is known from the first on.
class RecentLooksAtAnObject : public ::testing::Test {
 protected:
  struct TimedLook {
    VehicleTime time;
    Look look;
  };

  RecentLooksAtAnObject() {
    for (double time_s = 0.0; time_s < kEnd_s; time_s += 0.5) see(time_s);
  }

  void see(double time_s) {
    Look look = testing::lone_look({3.0 + 0.01 * time_s, -2.0}, 0.04, {0.1, 0.01 * time_s});
    look.observation.span = errors_.drift.cover(at_s(time_s), 0.5);
    look.observation.node_jacobian << 1.0, 0.0, 0.1, 0.02 * time_s, 0.0, 1.0, -0.1, 0.3;
    looks_.push_back({at_s(time_s), look});
    recent_.add(kId, at_s(time_s), look);
  }

  /// An object that the looks show which `are_its(time, look)` picks.
  template <typename AreIts>
  RestingObject& append(std::uint64_t id, const AreIts& are_its) {
    RestingObject& object = tracks_.append();
    object.track.id = id;
    object.prior = testing::ground_at(0.0);
    clear_sums(object);
    for (const TimedLook& timed : looks_) {
      if (are_its(timed)) add_look(object, timed.look, errors_.drift);
    }
    return object;
  }

  void thin_a_node() {
    const ThinnedNode node = *errors_.drift.next_to_thin();
    for (RestingObject& track : tracks_) track.landmark->thin(node, errors_.drift);
    errors_.drift.thin(node);
  }

  void expect_same(const RestingObject& a, const RestingObject& b) const {
    EXPECT_LT((a.landmark->A() - b.landmark->A()).norm(), 1e-8);
    EXPECT_LT((a.landmark->b() - b.landmark->b()).norm(), 1e-8);
    EXPECT_LT((a.pixel_information - b.pixel_information).norm(), 1e-8);
    for (const Landmark::NodeTerms& terms : *b.landmark) {
      const Landmark::NodeTerms* its = a.landmark->begin();
      while (its != a.landmark->end() && its->number != terms.number) ++its;
      ASSERT_NE(its, a.landmark->end());
      EXPECT_LT((its->B - terms.B).norm(), 1e-8);
      EXPECT_LT((its->C_own - terms.C_own).norm(), 1e-8);
      EXPECT_LT((its->C_next - terms.C_next).norm(), 1e-8);
    }
  }

  static constexpr std::uint64_t kId = 1, kOther = 2;
  static constexpr double kEnd_s = 30.0;
  ArrowheadSolver solver_{CalibrationPrior{}, DriftConfig{}};
  SharedErrorEstimate errors_{PositionAccuracy{0.8, 0.2, 0.02, 0.02}, testing::kHeightPrior, testing::kNoise,
                              DriftConfig{}, solver_};
  TrackTable tracks_{4};
  RecentLooks recent_{20};
  std::vector<TimedLook> looks_;
};

TEST_F(RecentLooksAtAnObject, AreTakenOutAsIfTheyHadNeverBeen) {
  RestingObject& object = append(kId, [](const TimedLook&) { return true; });
  const RestingObject& expected =
      append(kOther, [](const TimedLook& timed) { return timed.time < at_s(20.0); });
  object.sums_since = at_s(0.0);
  recent_.take_out(at_s(20.0), errors_.drift, tracks_);
  expect_same(object, expected);
}

TEST_F(RecentLooksAtAnObject, StayInAnObjectThatTheyBegan) {
  RestingObject& object = append(kId, [](const TimedLook&) { return true; });
  const RestingObject& expected = append(kOther, [](const TimedLook&) { return true; });
  object.sums_since = at_s(20.0);
  recent_.take_out(at_s(20.0), errors_.drift, tracks_);
  expect_same(object, expected);
}

/// What a look said of a node that is thinned out is spread over others, which have its number now: taken out
/// there, it would leave what never was.
TEST_F(RecentLooksAtAnObject, StayWhereTheirNodesHaveBeenThinnedOut) {
  for (const int thinned : {1, 3}) {
    for (const double since_s : {0.0, 4.0, 12.0, 25.0}) {
      while (tracks_.size() > 0) tracks_.remove(0);
      errors_.drift = DriftTimeline(DriftConfig{});
      looks_.clear();
      recent_.clear();
      for (double time_s = 0.0; time_s < kEnd_s; time_s += 0.5) see(time_s);
      DriftTimeline with_fewer = errors_.drift;
      for (int i = 0; i < thinned; ++i) with_fewer.thin(*with_fewer.next_to_thin());
      const std::uint32_t fine = with_fewer.begin_of_fine();
      ASSERT_GT(fine, errors_.drift.begin());
      ASSERT_LT(fine, errors_.drift.end() - 3);

      append(kId, [](const TimedLook&) { return true; });
      append(kOther, [&](const TimedLook& timed) {
        return timed.time < at_s(since_s) || timed.look.observation.span.first < fine;
      });
      for (int i = 0; i < thinned; ++i) thin_a_node();
      ASSERT_EQ(errors_.drift.begin_of_fine(), fine);
      tracks_[0].sums_since = at_s(-1.0);
      recent_.take_out(at_s(since_s), errors_.drift, tracks_);
      expect_same(tracks_[0], tracks_[1]);
    }
  }
}

TEST_F(RecentLooksAtAnObject, StayWhereTheirNodesAreFrozen) {
  append(kId, [](const TimedLook&) { return true; });
  append(kOther, [](const TimedLook& timed) { return timed.look.observation.span.first < 2; });
  for (int i = 0; i < 2; ++i) {
    for (RestingObject& track : tracks_) track.landmark->freeze(errors_.drift.begin(), errors_.drift);
    errors_.drift.freeze_oldest();
  }
  tracks_[0].sums_since = at_s(-1.0);
  recent_.take_out(at_s(0.0), errors_.drift, tracks_);
  expect_same(tracks_[0], tracks_[1]);
}

TEST_F(RecentLooksAtAnObject, FollowATrackThatIsRenamed) {
  RestingObject& object = append(kOther, [](const TimedLook&) { return true; });
  recent_.rename(kId, kOther);
  const RestingObject& expected = append(7, [](const TimedLook& timed) { return timed.time < at_s(9.0); });
  object.sums_since = at_s(0.0);
  recent_.take_out(at_s(9.0), errors_.drift, tracks_);
  expect_same(object, expected);
}

TEST_F(RecentLooksAtAnObject, LeaveNoneWhereAllAreTakenOut) {
  RestingObject& object = append(kId, [](const TimedLook&) { return true; });
  object.sums_since = at_s(-1.0);
  EXPECT_TRUE(has_looks(object));
  recent_.take_out(at_s(0.0), errors_.drift, tracks_);
  EXPECT_FALSE(has_looks(object));
}

/// One that was taken out as false is not taken out again.
TEST_F(RecentLooksAtAnObject, AreForgottenOneByOne) {
  const VehicleTime since = at_s(20.0);
  const TimedLook& gone = looks_[51];
  ASSERT_GT(gone.time, since);
  RestingObject& object = append(kId, [&](const TimedLook& timed) { return timed.time != gone.time; });
  const RestingObject& expected = append(kOther, [&](const TimedLook& timed) { return timed.time < since; });
  object.sums_since = at_s(0.0);
  recent_.forget(kOther, gone.look.observation);
  recent_.forget(kId, gone.look.observation);
  recent_.take_out(since, errors_.drift, tracks_);
  expect_same(object, expected);
}

/// Wherever the ring stood: of two steps of a clock, the second one takes out what came since the first.
TEST_F(RecentLooksAtAnObject, OfBeforeTheyWereForgottenStayForgotten) {
  recent_.clear();
  for (double time_s = kEnd_s; time_s < kEnd_s + 5.0; time_s += 0.5) see(time_s);
  RestingObject& object = append(kId, [](const TimedLook&) { return true; });
  const RestingObject& expected =
      append(kOther, [](const TimedLook& timed) { return timed.time < at_s(kEnd_s); });
  object.sums_since = at_s(0.0);
  recent_.take_out(at_s(1.0), errors_.drift, tracks_);
  expect_same(object, expected);
}

TEST_F(RecentLooksAtAnObject, AreForgottenWhenTheyAreTold) {
  RestingObject& object = append(kId, [](const TimedLook&) { return true; });
  const RestingObject& expected = append(kOther, [](const TimedLook&) { return true; });
  object.sums_since = at_s(0.0);
  recent_.clear();
  recent_.take_out(at_s(1.0), errors_.drift, tracks_);
  expect_same(object, expected);
}

}  // namespace
}  // namespace geoloc
