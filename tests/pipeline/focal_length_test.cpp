// SPDX-License-Identifier: Apache-2.0
// What the joint method promises of a camera whose focal length is not what it is said to be.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "support/map_laws.hpp"
#include "support/nadir_flight.hpp"
#include "support/wandering.hpp"

namespace geoloc {
namespace {

using testing::NadirFlight;
using testing::Path;
using testing::Pose;

constexpr double kHeight_m = 20.0;
constexpr double kSigmaTold_percent = 3.0;

/// The camera's focal length is so much longer than the estimator is told. All else is right, and believed to
/// be as uncertain as it usually is.
GeolocatorConfig config_for(double focal_percent, double sigma_percent) {
  GeolocatorConfig config;
  config.joint.prior.sigma_focal_percent = sigma_percent;
  CameraIntrinsics& camera = config.camera.intrinsics;
  camera.fx_px = camera.fy_px = testing::kFocal_px / (1.0 + 0.01 * focal_percent);
  return config;
}

/// To the north and back every 24 s. The camera looks along the body's down axis: ahead, where the vehicle's
/// nose is up.
Path to_and_fro(double pitch_rad) {
  return [=](double time_s) {
    const double leg_s = std::fmod(time_s, 24.0);
    return Pose{{0.0, 2.5 * (leg_s < 12.0 ? leg_s : 24.0 - leg_s), kHeight_m}, 0.0, pitch_rad, 0.0};
  };
}

Path straight_down() {
  return to_and_fro(0.0);
}

Path ahead() {
  return to_and_fro(40.0 * kRadPerDeg);
}

/// A tilt moves the image by as many pixels as the focal length makes of it.
Path leaning() {
  return [path = straight_down()](double time_s) {
    Pose pose = path(time_s);
    pose.roll = 0.05 * std::sin(time_s);
    pose.pitch = 0.05 * std::cos(0.7 * time_s);
    return pose;
  };
}

Path rising_and_sinking() {
  return [path = straight_down()](double time_s) {
    Pose pose = path(time_s);
    pose.position.z() += 10.0 * std::sin(0.2 * time_s);
    return pose;
  };
}

/// Over ground that no map knows.
std::vector<Eigen::Vector3d> field(double hills_m) {
  std::vector<Eigen::Vector3d> places;
  for (double north = -3.0; north <= 60.0; north += 4.5) {
    for (const double east : {-7.0, -1.0, 6.0})
      places.emplace_back(east, north, hills_m * std::sin(0.3 * north + 0.5 * east));
  }
  return places;
}

/// What a flight has besides its camera.
struct Aids {
  double hills_m = 0.5;
  bool has_rangefinder = false;
  double accuracy_m = JointTrackerConfig{}.horizontal_accuracy_m;  ///< of the receiver, as it is told
  std::vector<std::size_t> known_points = {};                      ///< of the field's places
};

/// Their places and heights are surveyed.
GeolocatorConfig told(GeolocatorConfig config, const std::vector<std::size_t>& known,
                      const std::vector<Eigen::Vector3d>& places) {
  for (const std::size_t i : known) {
    KnownPoint point;
    point.position = testing::geodetic_of(places[i].head<2>());
    point.height_m = 812.0 + places[i].z();
    point.sigma_height_m = 0.02;
    config.known_points.push_back(point);
  }
  return config;
}

/// What a flight of a minute and a half comes to.
struct Flown {
  Calibration calibration;
  double rmse_m = 0.0;
  double nees = 0.0;  ///< mean, 2 is right
  int found = 0;
};

constexpr double kFlight_s = 90.0;

/// The vehicle is not where it reports to be, as the prior expects it: it is off in position, height and yaw.
Path off_as_expected(const Path& reported, const JointTrackerConfig& joint, unsigned seed) {
  constexpr double kStep_s = 0.1;
  const auto steady = [](double time_constant_s) {
    DriftConfig process;
    process.ripple_share = 0.0;
    process.position_time_constant_s = time_constant_s;
    return process;
  };
  const DriftConfig& drift = joint.drift;
  const double sigma_m = std::sqrt(0.5 * (1.0 - joint.constant_share)) * joint.horizontal_accuracy_m;
  testing::WanderingPosition position(drift, sigma_m, kStep_s);
  testing::WanderingPosition height(steady(drift.up_time_constant_s), drift.sigma_up_m, kStep_s);
  testing::WanderingPosition yaw(steady(drift.yaw_time_constant_s), drift.sigma_yaw_deg * kRadPerDeg,
                                 kStep_s);
  std::mt19937 random(seed);
  std::vector<Eigen::Vector4d> errors;
  for (double time_s = 0.0; time_s < kFlight_s + 2.0; time_s += kStep_s) {
    const Eigen::Vector2d en = position.next(random);
    errors.emplace_back(en.x(), en.y(), height.next(random).x(), yaw.next(random).x());
  }
  return [=](double time_s) {
    const Eigen::Vector4d& error = errors[static_cast<std::size_t>(std::lround(time_s / kStep_s))];
    Pose pose = reported(time_s);
    pose.position += error.head<3>();
    pose.yaw += error[3];
    return pose;
  };
}

Flown fly(const GeolocatorConfig& config, const Path& path, unsigned seed, const Aids& aids,
          const Path& truth) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise_px(0.0, config.joint.sigma_px), noise_m(0.0, 0.1);
  const std::vector<Eigen::Vector3d> places = field(aids.hills_m);
  NadirFlight flight(told(config, aids.known_points, places), path, truth);
  for (double time_s = 0.5; time_s < kFlight_s; time_s += 0.2) {
    if (aids.has_rangefinder) {
      const Pose pose = path(time_s);
      const double distance_m = pose.position.z() / (std::cos(pose.roll) * std::cos(pose.pitch));
      flight.geolocator().add(RangeSample{testing::at_s(time_s), distance_m + noise_m(random)});
    }
    flight.see_points(time_s, places, [&] { return noise_px(random); });
  }
  Flown flown;
  flown.calibration = *flight.geolocator().calibration();
  for (const Eigen::Vector3d& place : places) {
    const Track* const object = testing::object_at(place.head<2>(), flight.tracks(), 1.0);
    if (object == nullptr) continue;
    const Eigen::Vector2d error = object->position_in_enu.mean - place.head<2>();
    flown.rmse_m += error.squaredNorm();
    flown.nees += error.dot(object->position_in_enu.covariance.inverse() * error);
    ++flown.found;
  }
  flown.rmse_m = std::sqrt(flown.rmse_m / flown.found);
  flown.nees /= flown.found;
  return flown;
}

Flown fly(const GeolocatorConfig& config, const Path& path, unsigned seed, const Aids& aids) {
  return fly(config, path, seed, aids, path);
}

/// That of a camera whose focal length is known.
Flown fly_with_right_focal_length(const Path& path, unsigned seed, const Aids& aids) {
  return fly(config_for(0.0, 0.0), path, seed, aids);
}

/// Objects are where they are with the right focal length.
void expect_as_good(const Flown& flown, const Flown& right) {
  EXPECT_EQ(flown.found, right.found);
  EXPECT_LT(flown.rmse_m, 1.1 * right.rmse_m + 0.01);
  EXPECT_LT(flown.nees, 2.0);
}

/// Where a flight shows the focal length, how well, and what it does to the map. Of the sigma, 0.6 % is for
/// what no look tells.
void expect_found(const Path& path, double most_sigma_percent, const Aids& aids = {}) {
  for (unsigned seed = 1; seed <= 2; ++seed) {
    const Flown right = fly_with_right_focal_length(path, seed, aids);
    for (const double percent : {-3.0, 0.0, 3.0}) {
      SCOPED_TRACE(::testing::Message() << percent << " %, seed " << seed);
      const Flown off = fly(config_for(percent, kSigmaTold_percent), path, seed, aids);
      const double sigma_percent = off.calibration.sigma_focal_percent();
      EXPECT_NEAR(off.calibration.focal_percent(), percent, sigma_percent);
      EXPECT_LT(sigma_percent, most_sigma_percent);
      expect_as_good(off, right);
    }
  }
}

TEST(FocalLength, IsFoundWhereTheHeightChanges) {
  expect_found(rising_and_sinking(), 0.8);
}

TEST(FocalLength, IsFoundWhereTheVehicleLeans) {
  expect_found(leaning(), 0.85);
}

TEST(FocalLength, IsFoundByACameraThatLooksAheadAtSurveyedPoints) {
  Aids aids;
  aids.known_points = {4, 6, 11, 16};
  expect_found(ahead(), 0.9, aids);
}

/// What is stated besides for what tilts tell wrongly.
constexpr double kOfTilts_percent = 0.6;

/// Over flights with focal lengths and a vehicle's errors as the prior expects them, the mean squared error
/// of the estimate in units of its stated variance is one where that is right. Of the variance, that of
/// `without_percent` is left out.
void expect_right_sigma(const Path& path, double without_percent, const Aids& aids = {}, double most = 3.0) {
  constexpr unsigned kFlights = 16;
  std::mt19937 random(5);
  std::normal_distribution<double> drawn_percent(0.0, kSigmaTold_percent);
  double sum = 0.0;
  for (unsigned seed = 1; seed <= kFlights; ++seed) {
    const double percent = drawn_percent(random);
    GeolocatorConfig config = config_for(percent, kSigmaTold_percent);
    config.joint.horizontal_accuracy_m = aids.accuracy_m;
    const Calibration found =
        fly(config, path, seed, aids, off_as_expected(path, config.joint, seed + kFlights)).calibration;
    const double variance = std::pow(found.sigma_focal_percent(), 2) - std::pow(without_percent, 2);
    sum += std::pow(found.focal_percent() - percent, 2) / variance;
  }
  EXPECT_GT(sum / kFlights, 0.5);
  EXPECT_LT(sum / kFlights, most);
}

TEST(FocalLength, IsAsUncertainAsIsStatedWhereTheHeightChanges) {
  expect_right_sigma(rising_and_sinking(), kOfTilts_percent);
}

/// The receiver is good to 0.3 m.
TEST(FocalLength, IsAsUncertainAsIsStatedWhereTheVehicleLeans) {
  Aids aids;
  aids.accuracy_m = 0.3;
  expect_right_sigma(leaning(), 0.0, aids);
}

/// What the position of a worse one ripples by between the nodes is taken for tilts in part.
TEST(FocalLength, IsLittleMoreUncertainThanIsStatedWhereTheVehicleLeansByAPoorReceiver) {
  expect_right_sigma(leaning(), 0.0, {}, 4.0);
}

TEST(FocalLength, IsAsUncertainAsIsStatedAheadOverSurveyedPoints) {
  Aids aids;
  aids.known_points = {4, 6, 11, 16};
  expect_right_sigma(ahead(), kOfTilts_percent, aids);
}

TEST(FocalLength, IsAsUncertainAsIsStatedWhereNothingShowsIt) {
  expect_right_sigma(straight_down(), kOfTilts_percent);
}

/// From one height, level and straight down, it is as good as a height: the map does not mind, and no sigma
/// claims that it was found.
TEST(FocalLength, IsNotKnownWhereNothingShowsIt) {
  const Flown right = fly_with_right_focal_length(straight_down(), 1, {});
  for (const double percent : {-3.0, 3.0}) {
    const Flown off = fly(config_for(percent, kSigmaTold_percent), straight_down(), 1, {});
    EXPECT_GT(off.calibration.sigma_focal_percent(), 0.8 * kSigmaTold_percent);
    EXPECT_NEAR(off.calibration.height_m(), -0.01 * percent * kHeight_m, 0.25);
    expect_as_good(off, right);
  }
}

/// A height that is measured is no focal length: what one explains of the scale, the other does not.
TEST(FocalLength, IsTheBetterKnownTheBetterTheHeightIs) {
  Aids rangefinder;
  rangefinder.has_rangefinder = true;
  const Flown without = fly(config_for(3.0, kSigmaTold_percent), straight_down(), 1, {});
  const Flown with = fly(config_for(3.0, kSigmaTold_percent), straight_down(), 1, rangefinder);
  EXPECT_LT(with.calibration.sigma_focal_percent(), 0.9 * without.calibration.sigma_focal_percent());
  EXPECT_LT(std::abs(with.calibration.focal_percent() - 3.0),
            std::abs(without.calibration.focal_percent() - 3.0));
}

TEST(FocalLength, ThatIsHeldForCertainIsNotCorrected) {
  Aids aids;
  aids.known_points = {4, 6, 11, 16};
  const Flown right = fly_with_right_focal_length(ahead(), 1, aids);
  const Flown frozen = fly(config_for(3.0, 0.0), ahead(), 1, aids);
  EXPECT_NEAR(frozen.calibration.focal_percent(), 0.0, 1e-6);
  EXPECT_FALSE(frozen.calibration.has_unknown_focal());
  EXPECT_GT(frozen.rmse_m, 1.3 * right.rmse_m);
}

}  // namespace
}  // namespace geoloc
