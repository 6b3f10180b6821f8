// SPDX-License-Identifier: Apache-2.0
#include "tracking/resting_object.hpp"
#include "support/landmark_position.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

#include "calibration/noise.hpp"
#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

using Index = CalibrationIndex;
using testing::ground_at;

constexpr double kGroundHeight_m = 0.6;

class RestingObjectSums : public ::testing::Test {
 protected:
  Look look_at(double time_s) {
    Look look = testing::lone_look({3.0, -2.0}, 0.04);
    look.observation.span = errors_.drift.cover(VehicleTime{from_seconds(time_s)}, 0.5);
    const auto fill = [&](auto&& matrix) {
      for (double& value : matrix.reshaped()) value = normal_(random_);
    };
    fill(look.observation.slope);
    fill(look.observation.calibration_jacobian);
    fill(look.observation.node_jacobian);
    look.pixel_noise << 0.04, 0.01, 0.01, 0.09;
    look.observation.information = (2.0 * look.pixel_noise).inverse();
    return look;
  }

  RestingObject& append() {
    RestingObject& object = tracks_.append();
    object.prior = ground_at(kGroundHeight_m);
    clear_sums(object);
    return object;
  }

  /// An object that these looks, and nothing else, have shown.
  RestingObject& append_seen(const std::vector<Look>& looks) {
    RestingObject& object = append();
    for (const Look& look : looks) add_look(object, look, errors_.drift);
    return object;
  }

  /// What the detector's noise and the priors leave unknown, from a list of looks.
  static PointMatrix pixel_information(const std::vector<Look>& looks, const PointMatrix& prior) {
    PointMatrix sum = prior;
    for (const Look& look : looks) {
      Eigen::Matrix<double, 2, 3> H;
      H << 1.0, 0.0, -look.observation.slope.x(), 0.0, 1.0, -look.observation.slope.y();
      sum += H.transpose() * look.pixel_noise.inverse() * H;
    }
    return sum;
  }

  /// Sums that no test can tell apart.
  void expect_same(const RestingObject& a, const RestingObject& b) const {
    EXPECT_LT((a.landmark->A() - b.landmark->A()).norm(), 1e-9);
    EXPECT_LT((a.landmark->b() - b.landmark->b()).norm(), 1e-9);
    EXPECT_LT((a.landmark->B() - b.landmark->B()).norm(), 1e-9);
    EXPECT_LT((a.landmark->C() - b.landmark->C()).norm(), 1e-9);
    EXPECT_LT((a.landmark->g() - b.landmark->g()).norm(), 1e-9);
    EXPECT_LT((a.pixel_information - b.pixel_information).norm(), 1e-9);
    const CalibrationVector calibration = CalibrationVector::LinSpaced(-0.3, 0.4);
    EXPECT_LT((position_of(*a.landmark, calibration, errors_.drift) -
               position_of(*b.landmark, calibration, errors_.drift))
                  .norm(),
              1e-9);
  }

  std::mt19937 random_{5};
  std::normal_distribution<double> normal_;
  ArrowheadSolver solver_{CalibrationPrior{}, DriftConfig{}};
  SharedErrorEstimate errors_{PositionAccuracy{0.8, 0.2, 0.02, 0.02}, testing::kHeightPrior, testing::kNoise,
                              DriftConfig{}, solver_};
  TrackTable tracks_{12};
};

/// One look and the ground: the object is where the ray meets the ground, and as unsure along the ray as the
/// ground is.
TEST_F(RestingObjectSums, OfOneLookAreThatLookOnTheGround) {
  RestingObject& object = append();
  object.landmark->add_prior({PointMatrix::Identity(), Point::Constant(50.0)});  // of a former object
  object.mixture.looks = 3;
  object.pixel_information.setConstant(7.0);
  object.last_look = VehicleTime{from_seconds(1.0)};
  const Look look = look_at(1.0);
  begin_sums(object, look, errors_);
  const Eigen::Vector2d slope = look.observation.slope;
  const Eigen::Vector2d place = Eigen::Vector2d(3.0, -2.0) + kGroundHeight_m * slope +
                                look.observation.calibration_jacobian * errors_.calibration.mean;
  EXPECT_LT((object.track.position_in_enu.mean - place).norm(), 1e-9);
  EXPECT_LT((object.position_in_enu - Point(place.x(), place.y(), kGroundHeight_m)).norm(), 1e-9);
  const double ground = testing::kSigmaGround_m * testing::kSigmaGround_m;
  Point ray;
  ray << slope, 1.0;
  const auto with_ground = [&](const Eigen::Matrix2d& noise) {
    PointMatrix covariance = ground * ray * ray.transpose();
    covariance.topLeftCorner<2, 2>() += noise;
    return covariance;
  };
  EXPECT_LT((object.own_covariance - with_ground(2.0 * look.pixel_noise)).norm(), 1e-9);
  EXPECT_LT((object.pixel_covariance - with_ground(look.pixel_noise)).norm(), 1e-9);
  EXPECT_EQ(object.mixture.looks, 0);
  EXPECT_EQ(object.sums_since, object.last_look);
}

/// The errors that are shared move the object along the level ground, and home beneath it. The noise of the
/// look's frame, of which the sums say how long it lasts, is in what is stated once.
TEST_F(RestingObjectSums, OfOneLookStateWhatIsSharedToo) {
  RestingObject& object = append();
  Look look = look_at(1.0);
  look.jacobian.middleCols<2>(SharedError::kFrame) << 0.3, 0.0, 0.1, 0.4;
  look.jacobian.col(SharedError::kTime) << -0.2, 0.5;
  begin_sums(object, look, errors_);
  const auto by_calibration = look.observation.calibration_jacobian.leftCols<SharedError::kCalibrationSize>();
  const Eigen::Matrix2d shared =
      by_calibration *
      errors_.calibration.covariance
          .topLeftCorner<SharedError::kCalibrationSize, SharedError::kCalibrationSize>() *
      by_calibration.transpose();
  const Eigen::Matrix2d frame = (Eigen::Matrix2d() << 0.09, 0.03, 0.03, 0.17).finished();
  const Eigen::Matrix2d time = (Eigen::Matrix2d() << 0.04, -0.1, -0.1, 0.25).finished();
  const Eigen::Matrix2d expected = object.pixel_covariance.topLeftCorner<2, 2>() + shared + frame + time;
  EXPECT_LT((object.track.position_in_enu.covariance - expected).norm(), 1e-9);
  const double height = std::hypot(testing::kSigmaGround_m, errors_.calibration.sigma(Index::kHeight));
  EXPECT_NEAR(object.sigma_height_m, height, 1e-9);
}

TEST_F(RestingObjectSums, CountTheDetectorsInformationOfEachLookAndTheGroundsOnce) {
  RestingObject& object = append();
  std::vector<Look> looks{look_at(1.0)};
  begin_sums(object, looks[0], errors_);
  for (int i = 0; i < 3; ++i) {
    looks.push_back(look_at(1.1 + 0.1 * i));
    add_to_sums(object, looks.back(), errors_);
  }
  const PointMatrix ground = ground_at(kGroundHeight_m).matrix;
  const PointMatrix pixels = pixel_information(looks, PointMatrix::Zero());
  EXPECT_LT((object.pixel_covariance - (pixels + ground).inverse()).norm(), 1e-9);
  EXPECT_LT((object.own_covariance - (0.5 * pixels + ground).inverse()).norm(), 1e-9);
}

TEST_F(RestingObjectSums, ThatAreClearedHoldThePriorAlone) {
  RestingObject& object = append_seen({look_at(0.0), look_at(1.0), look_at(7.0)});
  add_prior(object, {PointMatrix::Identity(), Point(1.0, 2.0, 3.0)});
  clear_sums(object);
  RestingObject& known = append();
  add_prior(known, {PointMatrix::Identity(), Point(1.0, 2.0, 3.0)});
  expect_same(object, known);
  EXPECT_EQ(object.landmark->begin(), object.landmark->end());
}

TEST_F(RestingObjectSums, TakeInAPriorAtAnyTime) {
  const std::vector<Look> looks{look_at(0.0), look_at(1.0), look_at(7.0)};
  const PointInformation survey{Point(4.0, 9.0, 0.0).asDiagonal(), Point(8.0, -9.0, 0.0)};
  RestingObject& early = append();
  add_prior(early, survey);
  for (const Look& look : looks) add_look(early, look, errors_.drift);
  RestingObject& late = append_seen(looks);
  add_prior(late, survey);
  expect_same(early, late);
  EXPECT_LT(
      (late.pixel_information - pixel_information(looks, ground_at(kGroundHeight_m).matrix + survey.matrix))
          .norm(),
      1e-9);
}

/// What it said before leaves no trace, and what a survey says stays.
TEST_F(RestingObjectSums, FollowTheGround) {
  const std::vector<Look> looks{look_at(0.0), look_at(1.0), look_at(7.0)};
  const PointInformation survey{Point(4.0, 9.0, 0.0).asDiagonal(), Point(8.0, -9.0, 0.0)};
  const Point row(-0.4, 0.1, 1.0);
  const PointInformation hillside{row * row.transpose() / 4.0, row * 7.0 / 4.0};
  RestingObject& moved = tracks_.append();
  moved.ground = moved.prior = ground_at(kGroundHeight_m);
  clear_sums(moved);
  for (const Look& look : looks) add_look(moved, look, errors_.drift);
  add_prior(moved, survey);
  set_ground(moved, ground_at(-8.0, 0.1));
  set_ground(moved, hillside);
  RestingObject& always_there = tracks_.append();
  always_there.ground = always_there.prior = hillside;
  clear_sums(always_there);
  for (const Look& look : looks) add_look(always_there, look, errors_.drift);
  add_prior(always_there, survey);
  expect_same(moved, always_there);
  EXPECT_LT((moved.prior.matrix - always_there.prior.matrix).norm(), 1e-9);
}

/// The looks of both and the ground once; what a survey said of either stays.
TEST_F(RestingObjectSums, OfTwoThatAreOneCountTheGroundOnce) {
  const PointInformation survey{Point(4.0, 9.0, 0.0).asDiagonal(), Point(8.0, -9.0, 0.0)};
  const std::vector<Look> looks_of_one{look_at(0.0), look_at(1.0), look_at(7.0)};
  const std::vector<Look> looks_of_other{look_at(8.0), look_at(12.0)};
  std::vector<Look> looks = looks_of_one;
  looks.insert(looks.end(), looks_of_other.begin(), looks_of_other.end());
  for (const int known : {0, 1, 2}) {
    RestingObject& kept = append_seen(looks_of_one);
    RestingObject& gone = append_seen(looks_of_other);
    RestingObject& expected = append_seen(looks);
    if (known > 0) {
      RestingObject& surveyed = known == 1 ? kept : gone;
      add_prior(surveyed, survey);
      surveyed.is_known = true;
      add_prior(expected, survey);
    }
    merge_sums(kept, gone, errors_.drift);
    expect_same(kept, expected);
    EXPECT_LT((kept.prior.matrix - expected.prior.matrix).norm(), 1e-12);
    EXPECT_LT((kept.prior.vector - expected.prior.vector).norm(), 1e-12);
    // What is merged can be made anew from its looks.
    clear_sums(kept);
    for (const Look& look : looks) add_look(kept, look, errors_.drift);
    expect_same(kept, expected);
  }
}

/// Look by look, the position follows the sums without being computed from all of them.
TEST_F(RestingObjectSums, KeepThePositionThatRefreshingFinds) {
  RestingObject& object = append();
  begin_sums(object, look_at(0.0), errors_);
  for (int i = 1; i < 40; ++i) {
    add_to_sums(object, look_at(0.5 * i), errors_);
    if (i == 12) add_prior(object, {PointMatrix::Identity(), Point(3.0, -2.0, 0.5)});
    if (i == 20) errors_.take(*solver_.solve({object.landmark}, errors_.prior(), errors_.drift));
    if (i == 20) refresh(object, errors_, errors_.drift.cover(VehicleTime{from_seconds(10.0)}, 0.5));
    if (i == 12) continue;  // a prior acts with the next look
    const Point expected = position_of(*object.landmark, errors_.calibration.mean, errors_.drift);
    ASSERT_LT((object.position_in_enu - expected).norm(), 1e-9) << i;
  }
  ASSERT_GT(errors_.drift.node(errors_.drift.begin()).mean.norm(), 1e-6);
}

/// The sensitivity is how the position moves with calibration and the present drift, in units of their
/// sigmas: by finite differences.
TEST_F(RestingObjectSums, MoveWithTheSharedErrors) {
  RestingObject& object = append();
  begin_sums(object, look_at(0.0), errors_);
  for (int i = 1; i < 30; ++i) add_to_sums(object, look_at(0.5 * i), errors_);
  errors_.take(*solver_.solve({object.landmark}, errors_.prior(), errors_.drift));
  const NodeSpan now = errors_.drift.cover(VehicleTime{from_seconds(14.8)}, 0.5);
  refresh(object, errors_, now);
  const Point before = object.position_in_enu;
  EXPECT_EQ(before.head<2>(), object.track.position_in_enu.mean);
  EXPECT_LT((before - position_of(*object.landmark, errors_.calibration.mean, errors_.drift)).norm(), 1e-12);
  constexpr double kStep = 1e-3;
  for (int i = 0; i < SharedError::kCalibrationSize; ++i) {
    CalibrationVector moved = errors_.calibration.mean;
    moved.head<SharedError::kCalibrationSize>() += kStep * errors_.calibration_root.col(i);
    const Point slope = (position_of(*object.landmark, moved, errors_.drift) - before) / kStep;
    EXPECT_LT((object.sensitivity.col(SharedError::kCalibration + i) - slope).norm(), 1e-6);
  }
  for (int i = 0; i < kNodeSize; ++i) {
    DriftTimeline moved = errors_.drift;
    for (const std::uint32_t number : {now.first, now.first + 1})
      moved.node(number).mean += kStep * errors_.drift_root.col(i);
    const Point slope = (position_of(*object.landmark, errors_.calibration.mean, moved) - before) / kStep;
    EXPECT_LT((object.sensitivity.col(SharedError::kDrift + i) - slope).norm(), 1e-6);
    EXPECT_GT(slope.norm(), 1e-6);
  }
}

}  // namespace
}  // namespace geoloc
