// SPDX-License-Identifier: Apache-2.0
// What is promised of a camera on a gimbal that reports its angles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "geoloc/state/state_provider.hpp"
#include "support/allocation_counter.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::Pose;

/// There and back on four legs of 32 m, 13 m apart, which the vehicle flies nose ahead while it shakes.
class Survey {
 public:
  static constexpr double kEnd_s = 4.0 * 13.0;

  Survey() {
    double yaw = 0.0;
    Eigen::Vector3d position(0.0, 0.0, 20.0);
    for (double time_s = 0.0; time_s < kEnd_s + 2.0; time_s += kStep_s) {
      yaw += kStep_s * turn_rate(time_s);
      position += kStep_s * 4.0 * Eigen::Vector3d(std::sin(yaw), std::cos(yaw), 0.0);
      poses_.push_back({position, 0.1 * std::sin(2.1 * time_s), 0.08 * std::sin(1.3 * time_s), yaw});
    }
  }

  Pose at(double time_s) const { return poses_[static_cast<std::size_t>(std::lround(time_s / kStep_s))]; }

 private:
  static constexpr double kStep_s = 0.01;

  /// Half a turn to the right and the left in turn, within five seconds after each leg of eight.
  static double turn_rate(double time_s) {
    constexpr double kLeg_s = 8.0, kTurn_s = 5.0;
    const double into_turn_s = std::fmod(time_s, kLeg_s + kTurn_s) - kLeg_s;
    const bool is_to_the_right = std::fmod(time_s, 2.0 * (kLeg_s + kTurn_s)) < kLeg_s + kTurn_s;
    if (into_turn_s < 0.0) return 0.0;
    const double rate = kPi / kTurn_s * (1.0 - std::cos(2.0 * kPi * into_turn_s / kTurn_s));
    return is_to_the_right ? rate : -rate;
  }

  std::vector<Pose> poses_;
};

struct Gimbal {
  double pitch_deg;
  bool holds_direction;
  GimbalYaw truly_from;
};

constexpr double kHeld_rad = 0.7;

double yaw_from_north(const Gimbal& gimbal, const Pose& vehicle) {
  return gimbal.holds_direction ? kHeld_rad : vehicle.yaw;
}

/// The pose of a vehicle that looks along its belly as the gimbal's camera looks (pixel_of_point()).
Pose camera_of(const Gimbal& gimbal, const Pose& vehicle) {
  return {vehicle.position, 0.0, (gimbal.pitch_deg + 90.0) * kRadPerDeg, yaw_from_north(gimbal, vehicle)};
}

/// What is measured is never quite even.
double noise_rad(double time_s) {
  return 3e-4 * std::sin(1e4 * time_s);
}

GimbalSample sample_of(const Gimbal& gimbal, double time_s, const Pose& vehicle,
                       bool has_wrong_flag = false) {
  const double from_north = yaw_from_north(gimbal, vehicle);
  const bool is_from_north = gimbal.truly_from == GimbalYaw::kFromNorth;
  const double yaw = is_from_north ? from_north : from_north - vehicle.yaw;
  return {testing::at_s(time_s),
          ned_from_body({noise_rad(time_s), gimbal.pitch_deg * kRadPerDeg + noise_rad(time_s + 0.05), yaw}),
          is_from_north != has_wrong_flag ? GimbalYaw::kFromNorth : GimbalYaw::kFromNose,
          gimbal.holds_direction};
}

/// Scattered evenly, and by no pattern that fits upon itself.
std::vector<Eigen::Vector2d> places() {
  constexpr double kFirstShare = 0.7548776662, kSecondShare = 0.5698402910;
  std::vector<Eigen::Vector2d> all;
  for (int i = 1; i <= 40; ++i)
    all.emplace_back(-15.0 + 65.0 * std::fmod(kFirstShare * i, 1.0),
                     -15.0 + 65.0 * std::fmod(kSecondShare * i, 1.0));
  return all;
}

std::vector<Detection> seen(const Pose& camera) {
  std::vector<Detection> detections;
  for (const Eigen::Vector2d& place : places()) {
    const auto pixel = testing::pixel_of(place, camera);
    const bool is_near = (place - camera.position.head<2>()).norm() < 60.0;
    if (pixel && is_near && std::abs(pixel->x() - 640.0) < 600.0 && std::abs(pixel->y() - 360.0) < 320.0)
      detections.push_back(testing::box_at(*pixel));
  }
  return detections;
}

void add_vehicle(Geolocator& geolocator, double time_s, const Pose& pose) {
  geolocator.add(testing::position_sample(time_s, pose));
  geolocator.add(testing::attitude_sample(time_s, pose));
}

FrameDetections frame_at(double time_s, const Pose& camera) {
  FrameDetections frame;
  frame.captured_at = testing::at_s(time_s);
  frame.captured_at_host = testing::host_at_s(time_s);
  frame.time_sigma_s = 1e-9;
  frame.detections = seen(camera);
  return frame;
}

GeolocatorConfig on_gimbal(Method method = Method::kJoint) {
  GeolocatorConfig config;
  config.method = method;
  config.camera.mount = CameraMount::on_gimbal();
  return config;
}

Geolocator flown(const GeolocatorConfig& config, const Gimbal& gimbal, bool has_wrong_flag = false) {
  const Survey survey;
  Geolocator geolocator(config);
  for (int tick = 0; 0.05 * tick < Survey::kEnd_s; ++tick) {
    const double time_s = 0.05 * tick;
    if (tick % 2 == 0) add_vehicle(geolocator, time_s, survey.at(time_s));
    if (tick % 2 == 1) geolocator.add(sample_of(gimbal, time_s, survey.at(time_s), has_wrong_flag));
    if (tick % 4 == 0 && tick > 20) geolocator.add(frame_at(time_s, camera_of(gimbal, survey.at(time_s))));
    while (geolocator.process_next()) {
    }
  }
  geolocator.finish();
  return geolocator;
}

double distance_to_nearest_m(const Track& track) {
  double nearest_m = 1e9;
  for (const Eigen::Vector2d& place : places())
    nearest_m = std::min(nearest_m, (track.position_in_enu.mean - place).norm());
  return nearest_m;
}

/// How many are confirmed, and how far the worst of them is off.
struct Map {
  int objects = 0;
  double worst_m = 0.0;
};

Map map_of(const Geolocator& geolocator) {
  Map map;
  for (const Track& track : geolocator.tracks()) {
    if (track.status != TrackStatus::kConfirmed) continue;
    ++map.objects;
    map.worst_m = std::max(map.worst_m, distance_to_nearest_m(track));
  }
  return map;
}

std::vector<Gimbal> all_gimbals() {
  std::vector<Gimbal> all;
  for (const double pitch_deg : {-90.0, -60.0, -45.0}) {
    for (const bool holds : {false, true}) {
      for (const GimbalYaw from : {GimbalYaw::kFromNose, GimbalYaw::kFromNorth})
        all.push_back({pitch_deg, holds, from});
    }
  }
  return all;
}

TEST(GimbalTelemetry, TellsWhereEachObjectIsWhateverTheVehicleDoes) {
  for (const Method method : {Method::kPaper, Method::kJoint}) {
    for (const Gimbal& gimbal : all_gimbals()) {
      const Geolocator geolocator = flown(on_gimbal(method), gimbal);
      const Map map = map_of(geolocator);
      EXPECT_GT(map.objects, 15) << gimbal.pitch_deg;
      EXPECT_LT(map.worst_m, 0.15) << gimbal.pitch_deg << ' ' << gimbal.holds_direction;
      EXPECT_EQ(geolocator.counters().maps_void, 0U);
      EXPECT_FALSE(geolocator.state().gimbal().is_yaw_told_wrong());
    }
  }
}

TEST(GimbalTelemetry, WithAWrongYawFlagIsNoticedAndLeavesNoFalseObject) {
  for (const Gimbal& gimbal : all_gimbals()) {
    const Geolocator geolocator = flown(on_gimbal(), gimbal, true);
    EXPECT_TRUE(geolocator.state().gimbal().is_yaw_told_wrong()) << gimbal.pitch_deg;
    EXPECT_EQ(geolocator.counters().maps_void, 1U);
    const Map map = map_of(geolocator);
    EXPECT_GT(map.objects, 10) << gimbal.pitch_deg << ' ' << gimbal.holds_direction;
    EXPECT_LT(map.worst_m, 0.15) << gimbal.pitch_deg << ' ' << gimbal.holds_direction;
  }
}

TEST(GimbalTelemetry, IsTakenAsAUserSaysWhoKnowsBetter) {
  GeolocatorConfig config = on_gimbal();
  const Gimbal gimbal{-45.0, false, GimbalYaw::kFromNorth};
  config.state.gimbal_yaw = GimbalYawReading::kFromNorth;
  const Geolocator geolocator = flown(config, gimbal, true);
  EXPECT_TRUE(geolocator.state().gimbal().is_yaw_told_wrong()) << "it is noticed nevertheless";
  EXPECT_EQ(geolocator.counters().maps_void, 0U);
  EXPECT_LT(map_of(geolocator).worst_m, 0.15);
}

TEST(GimbalTelemetry, IsWaitedForAsTheVehiclesIs) {
  const Survey survey;
  const Gimbal gimbal{-90.0, false, GimbalYaw::kFromNose};
  Geolocator geolocator(on_gimbal());
  for (int i = 0; i <= 30; ++i) add_vehicle(geolocator, 0.1 * i, survey.at(0.1 * i));
  for (int i = 0; i <= 15; ++i) geolocator.add(sample_of(gimbal, 0.1 * i, survey.at(0.1 * i)));
  geolocator.add(frame_at(1.55, camera_of(gimbal, survey.at(1.55))));
  EXPECT_EQ(geolocator.missing_state(testing::at_s(1.55)), NoState::kNotYet);
  EXPECT_FALSE(geolocator.process_next());
  geolocator.add(sample_of(gimbal, 1.6, survey.at(1.6)));
  EXPECT_EQ(geolocator.process_next()->fate, FrameFate::kLocated);
}

TEST(GimbalTelemetry, ThatNeverComesIsTheReasonForFramesThatAreNotLocated) {
  const Survey survey;
  const Gimbal gimbal{-90.0, false, GimbalYaw::kFromNose};
  Geolocator geolocator(on_gimbal());
  for (int i = 0; i <= 30; ++i) add_vehicle(geolocator, 0.1 * i, survey.at(0.1 * i));
  geolocator.add(frame_at(1.5, camera_of(gimbal, survey.at(1.5))));
  EXPECT_EQ(geolocator.missing_state(testing::at_s(1.5)), NoState::kNoGimbal);
  EXPECT_FALSE(geolocator.process_next()) << "it may come yet";
  EXPECT_EQ(geolocator.process_next(FrameWait::kNoLonger)->fate, FrameFate::kNoGimbal);
  EXPECT_NE(std::strstr(explain(FrameFate::kNoGimbal), "camera.mount.kind"), nullptr);
}

TEST(GimbalTelemetry, MeansNothingToACameraThatIsFixedToTheBody) {
  const Survey survey;
  const auto fly = [&](bool has_gimbal) {
    Geolocator geolocator{GeolocatorConfig{}};
    for (int i = 0; i <= 200; ++i) {
      add_vehicle(geolocator, 0.1 * i, survey.at(0.1 * i));
      if (has_gimbal)
        geolocator.add(sample_of({-20.0, true, GimbalYaw::kFromNorth}, 0.1 * i, survey.at(0.1 * i), true));
      geolocator.add(frame_at(0.1 * i, survey.at(0.1 * i)));
      while (geolocator.process_next()) {
      }
    }
    return geolocator;
  };
  const Geolocator with = fly(true), without = fly(false);
  ASSERT_EQ(with.tracks().size(), without.tracks().size());
  ASSERT_FALSE(with.tracks().empty());
  for (std::size_t i = 0; i < with.tracks().size(); ++i)
    EXPECT_EQ(with.tracks()[i].position_in_enu.mean, without.tracks()[i].position_in_enu.mean);
  EXPECT_EQ(with.state().counters().gimbals, 0U);
}

/// The camera is turned against the gimbal by what the joint method calls its boresight, wherever it looks.
TEST(GimbalTelemetry, OfACameraThatIsTurnedAgainstItsGimbalShowsByHowMuch) {
  const Survey survey;
  const Eigen::Vector3d boresight_rad(0.02, -0.015, 0.01);  // camera axes
  const Gimbal gimbal{-60.0, false, GimbalYaw::kFromNose};
  Geolocator geolocator(on_gimbal());
  const CameraModel lens{CameraIntrinsics{}};
  for (int tick = 0; 0.1 * tick < Survey::kEnd_s; ++tick) {
    const double time_s = 0.1 * tick;
    const Pose vehicle = survey.at(time_s);
    add_vehicle(geolocator, time_s, vehicle);
    geolocator.add(sample_of(gimbal, time_s, vehicle));
    const EulerAngles axes{0.0, gimbal.pitch_deg * kRadPerDeg, vehicle.yaw};
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(boresight_rad.norm(), boresight_rad.normalized()));
    const Rigid3d enu_from_camera{enu_from_ned() * ned_from_body(axes) * body_from_forward_camera() * turn,
                                  vehicle.position};
    FrameDetections frame = frame_at(time_s, vehicle);
    frame.detections.clear();
    for (const Eigen::Vector2d& place : places()) {
      const auto pixel = lens.pixel(enu_from_camera.inverse() * Eigen::Vector3d(place.x(), place.y(), 0.0));
      if (pixel && lens.contains(*pixel, 30.0)) frame.detections.push_back(testing::box_at(*pixel));
    }
    geolocator.add(frame);
    while (geolocator.process_next()) {
    }
  }
  geolocator.finish();
  EXPECT_LT((geolocator.calibration()->boresight_rad() - boresight_rad).norm(), 0.004);
  EXPECT_LT(map_of(geolocator).worst_m, 0.15);
}

TEST(GimbalTelemetry, TakesNoMemoryInFlight) {
  const Survey survey;
  const Gimbal gimbal{-90.0, false, GimbalYaw::kFromNose};
  Geolocator geolocator(on_gimbal());
  FrameDetections frame = frame_at(1.0, camera_of(gimbal, survey.at(1.0)));
  std::size_t before = 0;
  for (int i = 0; i < 400; ++i) {
    if (i == 20) before = testing::allocations();
    add_vehicle(geolocator, 0.1 * i, survey.at(0.1 * i));
    geolocator.add(sample_of(gimbal, 0.1 * i, survey.at(0.1 * i)));
    frame.captured_at = testing::at_s(0.1 * i);
    frame.captured_at_host = testing::host_at_s(0.1 * i);
    geolocator.add(frame);
    while (geolocator.process_next()) {
    }
  }
  EXPECT_EQ(testing::allocations(), before);
}

}  // namespace
}  // namespace geoloc
