// SPDX-License-Identifier: Apache-2.0
// The scale of the map, which nothing shows but how the vehicle moved: what biases a look by a little shows
// there first.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::NadirFlight;
using testing::Pose;

constexpr double kLeg_m = 10.0, kSpeed_mps = 3.0, kHeight_above_m = 20.0;
constexpr double kFlight_s = 200.0;
/// Far noisier than detectors are, so that little flight time shows it.
constexpr double kNoise_px = 6.0;
/// By then more than a hundred frames have been seen: no look is linearised anew after that.
constexpr double kFirstObject_s = 13.5;

std::vector<Eigen::Vector3d> field() {
  std::vector<Eigen::Vector3d> places;
  for (double north = -2.0; north <= kLeg_m + 2.0; north += 4.0) {
    for (const double east : {-4.0, 0.0, 4.0}) places.emplace_back(east, north, 0.0);
  }
  return places;
}

/// What is known but for the height, the drift and the objects' places.
GeolocatorConfig config_for(double wandering_m) {
  GeolocatorConfig config = testing::noisy_by_the_detector_alone();
  JointTrackerConfig& joint = config.joint;
  joint.sigma_px = kNoise_px;
  joint.prior.sigma_height_m = 2.0;
  joint.sigma_ground_m = 0.01;
  joint.horizontal_accuracy_m = wandering_m * std::sqrt(2.0 / (1.0 - joint.constant_share));
  if (wandering_m > 0.1) joint.fast_share = JointTrackerConfig{}.fast_share;
  return config;
}

/// The vehicle's position is off by a first-order Gauss-Markov process.
std::vector<Eigen::Vector2d> wandering(double sigma_m, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double kept = std::exp(-0.1 / JointTrackerConfig{}.drift.position_time_constant_s);
  std::vector<Eigen::Vector2d> wandered{Eigen::Vector2d::Zero()};
  for (int i = 0; i < 10.0 * (kFlight_s + 100.0); ++i) {
    const double east = normal(random), north = normal(random);
    wandered.emplace_back(kept * wandered.back() +
                          sigma_m * std::sqrt(1.0 - kept * kept) * Eigen::Vector2d(east, north));
  }
  return wandered;
}

/// The factor that takes the objects' true places to where they were found, about their mean.
double scale_of(const std::vector<Track>& tracks, const std::vector<Eigen::Vector3d>& places) {
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> pairs;  // true, found
  Eigen::Vector2d true_mean(0.0, 0.0), found_mean(0.0, 0.0);
  for (const Track& track : tracks) {
    const Eigen::Vector2d found = track.position_in_enu.mean;
    const auto nearest = std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
      return (a.template head<2>() - found).norm() < (b.template head<2>() - found).norm();
    });
    pairs.emplace_back(nearest->head<2>(), found);
    true_mean += nearest->head<2>();
    found_mean += found;
  }
  const auto count = static_cast<double>(pairs.size());
  double covariance = 0.0, variance = 0.0;
  for (const auto& [place, found] : pairs) {
    covariance += (place - true_mean / count).dot(found - found_mean / count);
    variance += (place - true_mean / count).squaredNorm();
  }
  return covariance / variance;
}

struct Flown {
  double height_m;  // of the camera, above what it is reported to be: truly none
  double sigma_height_m;
  double scale;
};

/// Back and forth above a field, at the height that is reported.
Flown fly(double wandering_m, unsigned seed) {
  std::mt19937 random(seed);
  const std::vector<Eigen::Vector2d> wandered = wandering(wandering_m, random);
  const testing::Path reported = [](double time_s) {
    const double legs = std::fmod(kSpeed_mps * time_s / kLeg_m, 2.0);
    return Pose{{0.0, kLeg_m * std::min(legs, 2.0 - legs), kHeight_above_m}, 0.0, 0.0, 0.0};
  };
  const testing::Path truth = [&](double time_s) {
    Pose pose = reported(time_s);
    pose.position.head<2>() += wandered[static_cast<std::size_t>(std::lround(10.0 * time_s))];
    return pose;
  };
  NadirFlight flight(config_for(wandering_m), reported, truth);
  std::normal_distribution<double> noise_px(0.0, kNoise_px);
  const std::vector<Eigen::Vector3d> places = field();
  for (double time_s = 0.5; time_s < kFirstObject_s - 0.05; time_s += 0.1) flight.process(time_s, {});
  for (double time_s = kFirstObject_s; time_s < kFirstObject_s + kFlight_s; time_s += 0.5)
    flight.see_points(time_s, places, [&] { return noise_px(random); });
  const Calibration calibration = *flight.geolocator().calibration();
  return {calibration.height_m(), calibration.sigma(CalibrationIndex::kHeight),
          scale_of(flight.tracks(), places)};
}

/// A sample's mean, and how well it is known from how the sample scatters.
struct Mean {
  double sum = 0.0, squares = 0.0;
  int count = 0;

  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double value() const { return sum / count; }
  double sigma() const { return std::sqrt((squares / count - value() * value()) / (count - 1)); }
};

void expect_within_its_scatter(const Mean& mean, double expected) {
  EXPECT_LT(std::abs(mean.value() - expected), 3.0 * mean.sigma())
      << mean.value() << " +- " << mean.sigma() << " of " << mean.count;
}

/// Linearised where they were measured, looks find the field 0.5 % smaller, and the camera lower by 6 sigmas.
TEST(MapScale, IsNotDrawnTowardsZeroByTheNoiseOfLooks) {
  Mean height_m, scale, deviation;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const Flown flown = fly(0.001, seed);
    height_m.add(flown.height_m);
    scale.add(flown.scale);
    deviation.add(flown.height_m / flown.sigma_height_m);
    EXPECT_LT(std::abs(flown.height_m), 3.0 * flown.sigma_height_m) << seed;
  }
  expect_within_its_scatter(height_m, 0.0);
  expect_within_its_scatter(scale, 1.0);
  EXPECT_LT(std::abs(deviation.value()), 3.0 / std::sqrt(12.0));
}

/// The less is known of the scale, the farther noise draws it: by 2.5 % here.
TEST(MapScale, IsNotDrawnTowardsZeroWhereTheVehicleWandersEither) {
  Mean height_m, scale;
  for (unsigned seed = 1; seed <= 16; ++seed) {
    const Flown flown = fly(0.3, seed);
    height_m.add(flown.height_m);
    scale.add(flown.scale);
  }
  expect_within_its_scatter(height_m, 0.0);
  expect_within_its_scatter(scale, 1.0);
  EXPECT_LT(scale.sigma(), 0.002);  // or nothing would be shown
}

}  // namespace
}  // namespace geoloc
