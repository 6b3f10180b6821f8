// SPDX-License-Identifier: Apache-2.0
#include "calibration/noise_estimate.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

constexpr double kExpectedPositionVariance_m2 = 0.01;

/// What is to be found, in the estimate's own terms.
struct Truth {
  double sigma_attitude_rad = 0.3 * kRadPerDeg;
  double position_factor = 1.0;
  double pixel_factor = 1.0;
};

/// A look at a place beside the one below the camera, as the shift of the ground that a turn of the camera
/// about right, forward and down axes makes: a pinhole's, by hand.
Eigen::Matrix<double, 2, 3> turn_of(double up_m, const Eigen::Vector2d& aside_m) {
  const double x = aside_m.x(), y = aside_m.y();
  Eigen::Matrix<double, 2, 3> turn;
  turn << -x * y / up_m, up_m + x * x / up_m, y, -(up_m + y * y / up_m), x * y / up_m, -x;
  return turn;
}

using FrameOfLooks = std::vector<Residual>;

/// Frames of a vehicle at one height after the other, with the noise that is to be found; own_covariance is
/// that of a detector whose pixel_factor is 1.
class Draws {
 public:
  Draws(const Truth& truth, unsigned seed) : truth_(truth), random_(seed) {}

  FrameOfLooks frame(double up_m, int looks) {
    const Eigen::Vector3d turned = truth_.sigma_attitude_rad * Eigen::Vector3d(normal(), normal(), normal());
    const Eigen::Vector2d shifted = std::sqrt(truth_.position_factor * kExpectedPositionVariance_m2) *
                                    Eigen::Vector2d(normal(), normal());
    const double sigma_m = 0.001 * up_m;
    FrameOfLooks frame;
    for (int i = 0; i < looks; ++i) {
      const Eigen::Vector2d aside = 0.3 * up_m * Eigen::Vector2d(normal(), normal());
      const Eigen::Vector2d own =
          std::sqrt(truth_.pixel_factor) * sigma_m * Eigen::Vector2d(normal(), normal());
      const auto turn = turn_of(up_m, aside);
      frame.push_back({turn * turned + shifted + own, turn, sigma_m * sigma_m * Eigen::Matrix2d::Identity(),
                       Eigen::Matrix2d::Zero()});
    }
    return frame;
  }

  /// From near and from far by turns: that tells the attitude's noise from the position's.
  std::vector<FrameOfLooks> flight(int frames, int looks) {
    std::vector<FrameOfLooks> flight;
    for (int i = 0; i < frames; ++i) flight.push_back(frame(i % 2 == 0 ? 8.0 : 80.0, looks));
    return flight;
  }

 private:
  double normal() { return normal_(random_); }

  Truth truth_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

/// As the tracker does it: looks know the detector's noise as it is known so far.
void learn(NoiseEstimate& noise, const FrameOfLooks& frame) {
  const double factor = noise.pixel_factor();
  noise.begin_frame();
  for (Residual look : frame) {
    look.own_covariance *= factor;
    noise.add(look);
  }
  noise.learn_from_frame(kExpectedPositionVariance_m2);
}

double sigma_attitude_deg(const NoiseEstimate& noise) {
  return std::sqrt(noise.attitude_variance_rad2()) * kDegPerRad;
}

NoiseEstimate learnt_from(const std::vector<FrameOfLooks>& flight, int times = 1) {
  NoiseEstimate noise(0.3 * kRadPerDeg);
  for (int i = 0; i < times; ++i) {
    for (const FrameOfLooks& frame : flight) learn(noise, frame);
  }
  return noise;
}

TEST(NoiseEstimate, IsWhatWasAssumedBeforeThereWereLooks) {
  NoiseEstimate noise(0.3 * kRadPerDeg);
  learn(noise, {});
  EXPECT_NEAR(sigma_attitude_deg(noise), 0.3, 1e-12);
  EXPECT_EQ(noise.position_factor(), 1.0);
  EXPECT_EQ(noise.pixel_factor(), 1.0);
}

/// A sixth of what was assumed is still told to a hundredth of a degree: the first frames are remembered.
TEST(NoiseEstimate, FindsTheAttitudesFromATwentiethOfADegreeToTwo) {
  for (const double sigma_deg : {0.05, 0.1, 0.3, 1.0, 2.0}) {
    Truth truth;
    truth.sigma_attitude_rad = sigma_deg * kRadPerDeg;
    const NoiseEstimate noise = learnt_from(Draws(truth, 1).flight(1000, 6));
    EXPECT_NEAR(sigma_attitude_deg(noise), sigma_deg, 0.1 * sigma_deg + 0.01);
    EXPECT_NEAR(noise.position_factor(), 1.0, 0.25) << sigma_deg;
    EXPECT_NEAR(noise.pixel_factor(), 1.0, 0.1) << sigma_deg;
  }
}

TEST(NoiseEstimate, FindsThePositionsBesideTheAttitudesByWhatGrowsWithTheRange) {
  for (const double factor : {0.1, 0.5, 4.0, 25.0}) {
    Truth truth;
    truth.position_factor = factor;
    const NoiseEstimate noise = learnt_from(Draws(truth, 2).flight(1000, 6));
    EXPECT_NEAR(noise.position_factor(), factor, 0.2 * factor + 0.05);
    EXPECT_NEAR(sigma_attitude_deg(noise), 0.3, 0.03) << factor;
  }
}

TEST(NoiseEstimate, FindsTheDetectorsByWhatLooksOfAFrameDoNotHaveInCommon) {
  for (const double factor : {0.2, 1.0, 3.0, 9.0}) {
    Truth truth;
    truth.pixel_factor = factor;
    const NoiseEstimate noise = learnt_from(Draws(truth, 3).flight(1500, 8));
    EXPECT_NEAR(noise.pixel_factor(), factor, 0.2 * std::max(1.0, factor));
    EXPECT_NEAR(sigma_attitude_deg(noise), 0.3, 0.03) << factor;
  }
}

/// One look a frame tells the attitude's noise where the detector's and the position's are small beside it.
TEST(NoiseEstimate, FindsTheAttitudesFromOneLookAFrame) {
  Truth truth;
  truth.sigma_attitude_rad = 1.0 * kRadPerDeg;
  const NoiseEstimate noise = learnt_from(Draws(truth, 4).flight(1000, 1));
  EXPECT_NEAR(sigma_attitude_deg(noise), 1.0, 0.15);
}

/// Not by much, and not the wrong way: five stills of two looks each.
TEST(NoiseEstimate, OfFewLooksIsBetweenWhatWasAssumedAndWhatTheyShow) {
  double mean_deg = 0.0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    Truth truth;
    truth.sigma_attitude_rad = 1.0 * kRadPerDeg;
    mean_deg += sigma_attitude_deg(learnt_from(Draws(truth, seed).flight(5, 2))) / 50.0;
  }
  EXPECT_GT(mean_deg, 0.6);
  EXPECT_LT(mean_deg, 1.0);
}

/// Pairs that are none: what is far off says as much as what is too far off by three sigmas.
TEST(NoiseEstimate, IsHardlyMovedByAFalsePair) {
  const std::vector<FrameOfLooks> flight = Draws({}, 5).flight(300, 5);
  const NoiseEstimate before = learnt_from(flight);
  std::array<double, 2> sigmas{};
  for (const std::size_t far : {0U, 1U}) {
    NoiseEstimate noise = before;
    FrameOfLooks frame = flight[0];
    frame[2].value.x() += far == 0 ? 30.0 : 3e6;
    learn(noise, frame);
    sigmas[far] = sigma_attitude_deg(noise);
    EXPECT_NEAR(sigmas[far] / sigma_attitude_deg(before), 1.0, 0.03);
    EXPECT_NEAR(noise.position_factor() / before.position_factor(), 1.0, 0.1);
    EXPECT_NEAR(noise.pixel_factor() / before.pixel_factor(), 1.0, 0.05);
  }
  EXPECT_NEAR(sigmas[0], sigmas[1], 1e-9);
}

/// Where calibration and drift are not known yet, what they do to all looks is not taken for position noise.
TEST(NoiseEstimate, CountsWhatIsNotKnownYetToNobody) {
  constexpr double kUnknown_m = 1.0;
  std::mt19937 random(6);
  std::normal_distribution<double> normal(0.0, kUnknown_m);
  std::vector<FrameOfLooks> flight = Draws({}, 6).flight(500, 5);
  for (FrameOfLooks& frame : flight) {
    const Eigen::Vector2d unknown(normal(random), normal(random));
    for (Residual& look : frame) {
      look.value += unknown;
      look.shared_covariance = kUnknown_m * kUnknown_m * Eigen::Matrix2d::Identity();
    }
  }
  const NoiseEstimate noise = learnt_from(flight);
  EXPECT_LT(noise.position_factor(), 3.0);  // of a hundred that are put in
  EXPECT_NEAR(sigma_attitude_deg(noise), 0.3, 0.05);
}

TEST(NoiseEstimate, FollowsWhatChanges) {
  Truth calm, rough;
  rough.sigma_attitude_rad = 1.5 * kRadPerDeg;
  NoiseEstimate noise = learnt_from(Draws(calm, 7).flight(5000, 5));
  EXPECT_NEAR(sigma_attitude_deg(noise), 0.3, 0.03);
  for (const FrameOfLooks& frame : Draws(rough, 8).flight(3000, 5)) learn(noise, frame);
  EXPECT_NEAR(sigma_attitude_deg(noise), 1.5, 0.25);
}

TEST(NoiseEstimate, OfAFrameFullOfLooksTakesTwelve) {
  const FrameOfLooks many = Draws({}, 9).frame(20.0, 40);
  NoiseEstimate all(0.3 * kRadPerDeg), first(0.3 * kRadPerDeg);
  learn(all, many);
  learn(first, {many.begin(), many.begin() + 12});
  EXPECT_EQ(all.attitude_variance_rad2(), first.attitude_variance_rad2());
  EXPECT_EQ(all.position_factor(), first.position_factor());
  EXPECT_EQ(all.pixel_factor(), first.pixel_factor());
}

TEST(NoiseEstimate, IsFiniteWhereTheReceiverIsExact) {
  NoiseEstimate noise(0.3 * kRadPerDeg);
  for (const FrameOfLooks& frame : Draws({}, 10).flight(200, 4)) {
    noise.begin_frame();
    for (const Residual& look : frame) noise.add(look);
    noise.learn_from_frame(0.0);
  }
  EXPECT_TRUE(std::isfinite(noise.attitude_variance_rad2()));
  EXPECT_TRUE(std::isfinite(noise.position_factor()));
  EXPECT_TRUE(std::isfinite(noise.pixel_factor()));
  EXPECT_GT(noise.attitude_variance_rad2(), 0.0);
}

// --- Brute force.

/// -2 ln of the density of all residuals of a flight, frame by frame, with the full covariance of each.
double deviance(const std::vector<FrameOfLooks>& flight, const Truth& noise) {
  double sum = 0.0;
  for (const FrameOfLooks& frame : flight) {
    const auto n = static_cast<Eigen::Index>(frame.size());
    Eigen::VectorXd value(2 * n);
    Eigen::MatrixXd turn(2 * n, 3), shift(2 * n, 2);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Residual& look = frame[static_cast<std::size_t>(i)];
      value.segment<2>(2 * i) = look.value;
      turn.middleRows<2>(2 * i) = look.turn;
      shift.middleRows<2>(2 * i).setIdentity();
      covariance.block<2, 2>(2 * i, 2 * i) = noise.pixel_factor * look.own_covariance;
    }
    covariance += std::pow(noise.sigma_attitude_rad, 2) * turn * turn.transpose() +
                  noise.position_factor * kExpectedPositionVariance_m2 * shift * shift.transpose();
    const Eigen::LLT<Eigen::MatrixXd> root(covariance);
    sum += value.dot(root.solve(value));
    for (Eigen::Index i = 0; i < 2 * n; ++i) sum += 2.0 * std::log(root.matrixLLT()(i, i));
  }
  return sum;
}

/// The noise that makes a flight most probable: by steps along one unknown after the other.
Truth most_probable(const std::vector<FrameOfLooks>& flight) {
  Truth best;
  double least = deviance(flight, best);
  for (double step = 1.5; step > 1.005; step = std::sqrt(step)) {
    for (bool is_better = true; is_better;) {
      is_better = false;
      for (double Truth::*const unknown :
           {&Truth::sigma_attitude_rad, &Truth::position_factor, &Truth::pixel_factor}) {
        for (const double factor : {step, 1.0 / step}) {
          Truth other = best;
          other.*unknown *= factor;
          const double cost = deviance(flight, other);
          if (!(cost < least)) continue;
          least = cost;
          best = other;
          is_better = true;
        }
      }
    }
  }
  return best;
}

/// A flight of 24 frames, repeated until what was assumed at first counts for little: the fixed point is
/// where the likelihood has its maximum. The detector's noise, of which 200 observations are assumed, is the
/// most that remembers that.
TEST(NoiseEstimate, OfAFlightThatIsRepeatedIsTheMostProbable) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    Truth truth;
    truth.sigma_attitude_rad = 0.6 * kRadPerDeg;
    truth.position_factor = 2.0;
    const std::vector<FrameOfLooks> flight = Draws(truth, seed).flight(24, 4);
    const Truth expected = most_probable(flight);
    const NoiseEstimate noise = learnt_from(flight, 300);
    EXPECT_NEAR(std::sqrt(noise.attitude_variance_rad2()) / expected.sigma_attitude_rad, 1.0, 0.05);
    EXPECT_NEAR(noise.position_factor() / expected.position_factor, 1.0, 0.1);
    EXPECT_NEAR(noise.pixel_factor() / expected.pixel_factor, 1.0, 0.06);
  }
}

}  // namespace
}  // namespace geoloc
