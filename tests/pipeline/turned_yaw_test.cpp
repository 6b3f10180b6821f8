// SPDX-License-Identifier: Apache-2.0
// What is promised of a survey of stills whose yaw is 180 deg off in some.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/pipeline/geolocator.hpp"
#include "support/allocation_counter.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::Pose;

constexpr int kStills = 18;
constexpr double kPeriod_s = 2.0;

/// Two lanes of nine stills 8 m apart, to the north and back, 40 m up and hardly tilted.
Pose pose_of(int still) {
  const bool is_back = still >= kStills / 2;
  const double north_m = 8.0 * (is_back ? kStills - 1 - still : still);
  return {{is_back ? 20.0 : 0.0, north_m, 40.0},
          0.03 * std::sin(still),
          0.02 * std::cos(still),
          is_back ? kPi : 0.0};
}

std::vector<Eigen::Vector2d> scattered() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> east(-15.0, 35.0), north(-5.0, 70.0);
  std::vector<Eigen::Vector2d> places;
  while (places.size() < 40) {
    const Eigen::Vector2d place(east(random), north(random));
    const auto is_near = [&](const Eigen::Vector2d& other) { return (place - other).norm() < 3.0; };
    if (std::none_of(places.begin(), places.end(), is_near)) places.push_back(place);
  }
  return places;
}

/// 10 m apart, also beyond the edge of what the first stills show.
std::vector<Eigen::Vector2d> in_rows() {
  std::vector<Eigen::Vector2d> places;
  for (double east = -15.0; east <= 35.0; east += 10.0) {
    for (double north = -5.0; north <= 75.0; north += 10.0) places.emplace_back(east, north);
  }
  return places;
}

/// Telemetry at the stills and at no other time.
class Survey {
 public:
  Survey(std::vector<Eigen::Vector2d> places, std::set<int> turned)
      : places_(std::move(places)), turned_(std::move(turned)) {}

  void see(int still) {
    const Pose pose = pose_of(still);
    const double time_s = kPeriod_s * still;
    PositionSample position;
    position.time = testing::at_s(time_s);
    position.position = testing::geodetic_of(pose.position.head<2>());
    position.height_above_home_m = pose.position.z();
    geolocator_.add(position);
    const double told_yaw_rad = wrap_to_pi(pose.yaw + (turned_.count(still) > 0 ? kPi : 0.0));
    geolocator_.add(AttitudeSample{testing::at_s(time_s), {pose.roll, pose.pitch, told_yaw_rad}});
    frame_.captured_at = testing::at_s(time_s);
    frame_.captured_at_host = testing::host_at_s(time_s);
    frame_.time_sigma_s = 1e-3;
    frame_.detections.clear();
    for (const Eigen::Vector2d& place : places_) {
      const auto pixel = testing::pixel_of(place, pose);
      const bool is_inside = pixel && pixel->x() > 20.0 && pixel->x() < testing::kImageWidth_px - 20.0 &&
                             pixel->y() > 20.0 && pixel->y() < testing::kImageHeight_px - 20.0;
      if (is_inside) frame_.detections.push_back(testing::box_at(*pixel + Eigen::Vector2d(noise(), noise())));
    }
    ASSERT_TRUE(geolocator_.process(frame_)) << still;
  }

  const Geolocator& geolocator() const { return geolocator_; }

  std::uint64_t frames_turned() const { return geolocator_.track_counters().frames_turned; }

  /// Confirmed objects, and those of them that stand within 0.5 m of a place.
  std::pair<int, int> objects() const {
    int all = 0, right = 0;
    for (const Track& track : geolocator_.tracks()) {
      if (track.status != TrackStatus::kConfirmed) continue;
      ++all;
      right += std::any_of(places_.begin(), places_.end(), [&](const Eigen::Vector2d& place) {
        return (place - track.position_in_enu.mean).norm() < 0.5;
      });
    }
    return {all, right};
  }

 private:
  double noise() { return pixels_(random_); }

  std::vector<Eigen::Vector2d> places_;
  std::set<int> turned_;
  Geolocator geolocator_{GeolocatorConfig{}};
  FrameDetections frame_;
  std::mt19937 random_{1};
  std::normal_distribution<double> pixels_{0.0, 1.0};
};

TEST(TurnedYaw, SixOfEighteenAreUsedTheRightWayRound) {
  Survey straight(scattered(), {}), turned(scattered(), {2, 5, 8, 11, 14, 17});
  for (int still = 0; still < kStills; ++still) {
    straight.see(still);
    turned.see(still);
    const auto told = turned.geolocator().view().vehicle.enu_from_body.rotation;
    const auto truth = straight.geolocator().view().vehicle.enu_from_body.rotation;
    EXPECT_LT(told.angularDistance(truth), 0.1) << still;
  }
  EXPECT_EQ(straight.frames_turned(), 0U);
  EXPECT_EQ(turned.frames_turned(), 6U);
  EXPECT_GT(straight.objects().second, 30);
  EXPECT_GE(turned.objects().second, straight.objects().second - 1);
  EXPECT_EQ(turned.objects().first, turned.objects().second);
}

/// Whether the first still or the others are wrong, the others tell.
TEST(TurnedYaw, OfTheFirstStillIsOutvoted) {
  Survey survey(scattered(), {0});
  for (int still = 0; still < kStills; ++still) survey.see(still);
  EXPECT_GT(survey.objects().second, 30);
  EXPECT_EQ(survey.objects().first, survey.objects().second);
  EXPECT_LE(survey.frames_turned(), 1U);
}

/// What lies beyond the edge of a field of rows is new, not the other edge.
TEST(TurnedYaw, IsNoneOverObjectsInRows) {
  Survey survey(in_rows(), {});
  for (int still = 0; still < kStills; ++still) survey.see(still);
  EXPECT_EQ(survey.frames_turned(), 0U);
  EXPECT_EQ(survey.objects().first, survey.objects().second);
}

TEST(TurnedYaw, AllocatesNothing) {
  Survey survey(scattered(), {5, 8});
  for (int still = 0; still < 5; ++still) survey.see(still);
  const std::size_t before = testing::allocations();
  for (int still = 5; still < 10; ++still) survey.see(still);
  EXPECT_EQ(survey.frames_turned(), 2U);
  EXPECT_EQ(testing::allocations(), before);
}

}  // namespace
}  // namespace geoloc
