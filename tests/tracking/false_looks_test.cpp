// SPDX-License-Identifier: Apache-2.0
#include "tracking/false_looks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

constexpr double kVariance_m2 = 0.01;
const Eigen::Vector2d kPlace{3.0, -2.0};
/// One in three lone looks is an object, and one false box falls in ten images.
constexpr FalseOdds kOdds{2.0, 0.1};

class FalseLooks : public ::testing::Test {
 protected:
  FalseLooks() { errors_.drift.cover(VehicleTime{}, 0.5); }

  /// At the object, which stands on the ground, or at what a look along that ray would show it as.
  Look look_along(double slope, const Eigen::Vector2d& aside = Eigen::Vector2d::Zero()) {
    const double sigma_m = std::sqrt(kVariance_m2);
    const Eigen::Vector2d noise{sigma_m * normal_(random_), sigma_m * normal_(random_)};
    return testing::lone_look(kPlace + aside + noise, kVariance_m2, {slope, 0.0});
  }

  RestingObject& begin(const Look& look) {
    RestingObject& object = tracks_.append();
    object.prior = testing::ground_at(0.0);
    object.track.hits = 1;
    begin_sums(object, look, errors_);
    return object;
  }

  int absorb(RestingObject& object, const Look& look) {
    ++object.track.hits;
    add_to_sums(object, look, errors_);
    return drop_false_looks(object, look, kOdds, errors_) ? 1 : 0;
  }

  /// Looks from one side to the other.
  int pass(RestingObject& object, int looks) {
    int dropped = 0;
    for (int i = 0; i < looks; ++i) dropped += absorb(object, look_along(-0.5 + i / (looks - 1.0)));
    return dropped;
  }

  std::mt19937 random_{3};
  std::normal_distribution<double> normal_;
  ArrowheadSolver solver_{{}, {}};
  SharedErrorEstimate errors_{
      PositionAccuracy{0.3, 0.15, 0.04, 0.04}, testing::kHeightPrior, NoiseEstimate(0.002), {}, solver_};
  TrackTable tracks_{1000};
};

/// Sums without a look are those that never had it.
TEST_F(FalseLooks, AFirstLookThatTheOthersContradictIsTakenOutOfTheSums) {
  RestingObject& object = begin(look_along(0.7, {2.5, 0.0}));
  random_.seed(7);
  EXPECT_EQ(pass(object, 10), 1);
  random_.seed(7);
  RestingObject& never_had_it = begin(look_along(-0.5));
  for (int i = 1; i < 10; ++i) absorb(never_had_it, look_along(-0.5 + i / 9.0));
  EXPECT_LT((object.landmark->A() - never_had_it.landmark->A()).norm(), 1e-9 * object.landmark->A().norm());
  EXPECT_LT((object.position_in_enu - never_had_it.position_in_enu).norm(), 1e-9);
  EXPECT_EQ(object.track.hits, never_had_it.track.hits);
}

/// Whatever one look says of a height that was open, the others decide.
TEST_F(FalseLooks, ALaterLookThatAloneToldTheHeightIsTakenOutWhereTheOthersContradictIt) {
  RestingObject& object = begin(look_along(0.5));
  for (int i = 0; i < 5; ++i) absorb(object, look_along(0.5));
  EXPECT_EQ(absorb(object, look_along(-0.5, {-1.5, 0.0})), 0);
  EXPECT_GT(std::abs(object.position_in_enu.z()), 1.0);
  EXPECT_EQ(pass(object, 10), 1);
  EXPECT_LT(std::abs(object.position_in_enu.z()), 0.3);
}

TEST_F(FalseLooks, LooksThatAreOffByNoiseStay) {
  int dropped = 0;
  for (int i = 0; i < 900; ++i) {
    dropped += pass(begin(look_along(0.7)), 10);
    tracks_.remove(0);
  }
  EXPECT_LE(dropped, 18);  // 2 %: the nine looks after the first one ask nine times
}

/// Where only one side has been seen, what is far along the ray may well be the object, higher or lower.
TEST_F(FalseLooks, NothingIsTakenOutWhileTheHeightIsOpen) {
  RestingObject& object = begin(look_along(0.8, {0.9, 0.0}));  // 3 m lower
  for (int i = 0; i < 10; ++i) EXPECT_EQ(absorb(object, look_along(0.5)), 0);
}

/// A node that was thinned out has taken the look's terms with it.
TEST_F(FalseLooks, SumsBeginAnewWhereTheLookIsInThemNoMore) {
  RestingObject& object = begin(look_along(0.7, {2.5, 0.0}));
  for (int i = 1; i < 4; ++i) errors_.drift.cover(VehicleTime{from_seconds(3.0 * i)}, 0.5);
  const auto thinned = errors_.drift.next_to_thin();
  ASSERT_TRUE(thinned);
  object.landmark->thin(*thinned, errors_.drift);
  errors_.drift.thin(*thinned);
  int dropped = 0;
  Look last = look_along(0.0);
  for (int i = 0; i < 10 && dropped == 0; ++i) {
    last = look_along(-0.5 + 0.1 * i);
    last.observation.span = {errors_.drift.end() - 2, 0.5};
    dropped = absorb(object, last);
  }
  EXPECT_EQ(dropped, 1);
  EXPECT_LT((object.track.position_in_enu.mean - last.position).norm(), 1e-6);
}

/// What each look says agrees with the object as often as its sigmas let expect; the shared error of a
/// frame's time counts as the look states it where the object should be seen, here along east.
TEST_F(FalseLooks, LooksFarAsideAgreeOnlyAlongWhatTheFrameMayBeOffBy) {
  constexpr double kGate = 11.8;
  RestingObject& object = begin(look_along(0.0));
  pass(object, 20);
  const auto agrees_at = [&](const Eigen::Vector2d& aside) {
    LandmarkObservation observation = testing::lone_look(kPlace + aside, kVariance_m2).observation;
    const Eigen::Vector2d late_m(8.0, 0.0);
    observation.information =
        (kVariance_m2 * Eigen::Matrix2d::Identity() + late_m * late_m.transpose()).inverse();
    return agrees(observation, object, kGate, errors_);
  };
  EXPECT_TRUE(agrees_at({0.0, 0.0}));
  EXPECT_TRUE(agrees_at({20.0, 0.0}));
  EXPECT_FALSE(agrees_at({40.0, 0.0}));
  EXPECT_FALSE(agrees_at({0.0, 1.0}));
  EXPECT_FALSE(agrees_at({20.0, 1.0}));
}

TEST_F(FalseLooks, FarIsAMatterOfTheCamerasHeight) {
  Look look = look_along(0.0);
  JointAssociation::Match match;
  match.innovation = {3.0, 0.0};
  look.camera_height_m = 20.0;
  EXPECT_TRUE(is_far(look, match));
  look.camera_height_m = 80.0;
  EXPECT_FALSE(is_far(look, match));
}

}  // namespace
}  // namespace geoloc
