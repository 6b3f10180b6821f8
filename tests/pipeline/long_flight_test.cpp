// SPDX-License-Identifier: Apache-2.0
// What is promised of flights however long they are: an hour, of which little more than a minute is
// remembered in full.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"
#include "geoloc/state/state_provider.hpp"
#include "support/allocation_counter.hpp"
#include "support/map_laws.hpp"
#include "support/nadir_flight.hpp"
#include "support/wandering.hpp"

namespace geoloc {
namespace {

using testing::NadirFlight;
using testing::Path;
using testing::Pose;

constexpr double kHour_s = 3600.0;
/// So long above the first field, at the beginning and again at the end.
constexpr double kVisit_s = 60.0;
constexpr double kNoise_px = 1.5;

std::vector<Eigen::Vector3d> grid(double north_from_m, double north_to_m) {
  std::vector<Eigen::Vector3d> places;
  for (double north = north_from_m; north <= north_to_m; north += 6.0) {
    for (const double east : {-6.0, 0.0, 5.0}) places.emplace_back(east, north, 0.0);
  }
  return places;
}

/// The first field, and those that are seen in between.
const std::vector<Eigen::Vector3d> kFirst = grid(0.0, 18.0), kOthers = grid(60.0, 90.0);

std::vector<Eigen::Vector3d> all_places() {
  std::vector<Eigen::Vector3d> places = kFirst;
  places.insert(places.end(), kOthers.begin(), kOthers.end());
  return places;
}

/// Back and forth above the first field, the others for an hour, and the first again.
Pose as_planned(double time_s, double length_s) {
  const auto to_and_fro = [](double along_s, double from_m, double length_m) {
    const double legs = std::fmod(3.0 * along_s / length_m, 2.0);
    return from_m + length_m * std::min(legs, 2.0 - legs);
  };
  const double back_s = length_s - kVisit_s;
  constexpr double kWay_s = 20.0;
  double north_m = 0.0;
  if (time_s < kVisit_s) {
    north_m = to_and_fro(time_s, 0.0, 18.0);
  } else if (time_s < kVisit_s + kWay_s) {
    north_m = 3.0 * (time_s - kVisit_s);
  } else if (time_s < back_s) {
    north_m = to_and_fro(time_s - kVisit_s - kWay_s, 60.0, 30.0);
  } else if (time_s < back_s + kWay_s) {
    north_m = 60.0 - 3.0 * (time_s - back_s);
  } else {
    north_m = to_and_fro(time_s - back_s - kWay_s, 0.0, 18.0);
  }
  return {{0.0, north_m, 20.0}, 0.02 * std::sin(0.7 * time_s), 0.02 * std::cos(0.5 * time_s), 0.0};
}

/// What the receiver's position is off by, as strong as it reports.
class Wandering {
 public:
  Wandering(double length_s, unsigned seed) {
    const JointTrackerConfig joint;
    const double sigma_m = std::sqrt(0.5 * (1.0 - joint.constant_share)) * joint.horizontal_accuracy_m;
    std::mt19937 random(seed);
    testing::WanderingPosition wandering(joint.drift, sigma_m, 0.1);
    for (int i = 0; i < 10.0 * (length_s + 10.0); ++i) off_m_.push_back(wandering.next(random));
  }

  Eigen::Vector2d at(double time_s) const {
    return off_m_[static_cast<std::size_t>(std::lround(10.0 * time_s))];
  }

 private:
  std::vector<Eigen::Vector2d> off_m_;
};

/// A flight of so long that begins and ends above the first field.
class LongFlight {
 public:
  LongFlight(double length_s, double period_s, unsigned seed)
      : period_s_(period_s),
        wandering_(length_s, seed),
        random_(seed),
        flight_(
            GeolocatorConfig{}, [=](double time_s) { return as_planned(time_s, length_s); },
            [=](double time_s) {
              Pose pose = as_planned(time_s, length_s);
              pose.position.head<2>() += wandering_.at(time_s);
              return pose;
            }) {}

  void fly_until(double end_s) {
    for (; time_s() < end_s; ++frame_)
      flight_.see_points(time_s(), all_places(), [&] { return noise_px_(random_); });
  }

  double time_s() const { return period_s_ * frame_; }

  /// The one confirmed object there; nullptr: none, or several.
  const Track* object_at(const Eigen::Vector3d& place) const {
    return testing::object_at(place.head<2>(), flight_.tracks(), 2.4);
  }

  /// Squared error of the first field, against the covariance that is stated of it: 2 on average. Its objects
  /// are off by the same for the most part.
  double squared_deviation() const {
    Eigen::Vector2d error = Eigen::Vector2d::Zero();
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
    for (const Eigen::Vector3d& place : kFirst) {
      const Track* const object = object_at(place);
      if (object == nullptr) {
        ADD_FAILURE() << "not one object at " << place.transpose();
        return 0.0;
      }
      error += object->position_in_enu.mean - place.head<2>();
      covariance += object->position_in_enu.covariance;
    }
    const auto count = static_cast<double>(kFirst.size());
    return error.dot(covariance.inverse() * error) / count;
  }

  NadirFlight& flight() { return flight_; }

 private:
  double period_s_;
  Wandering wandering_;
  std::mt19937 random_;
  std::normal_distribution<double> noise_px_{0.0, kNoise_px};
  NadirFlight flight_;
  int frame_ = 1;
};

std::vector<std::uint64_t> ids_of(const LongFlight& flight, const std::vector<Eigen::Vector3d>& places) {
  std::vector<std::uint64_t> ids;
  for (const Eigen::Vector3d& place : places) {
    const Track* const object = flight.object_at(place);
    ids.push_back(object == nullptr ? 0 : object->id);
  }
  return ids;
}

/// By so much may the mean of `count` squared deviations of two components exceed 2, once in a thousand times
/// (chi-square; Wilson and Hilferty).
double most_by_chance(int count) {
  const double freedom = 2.0 * count, spread = 2.0 / (9.0 * freedom);
  return 2.0 * std::pow(1.0 - spread + 3.09 * std::sqrt(spread), 3);
}

/// More than the nodes that are kept in full: what an object's looks say of older ones still holds.
TEST(LongFlights, KnowWhatTheySawAtFirstAsWellAsTheyState) {
  constexpr double kLength_s = 400.0;
  constexpr int kFlights = 3;
  double at_first = 0.0, at_last = 0.0;
  for (unsigned seed = 1; seed <= kFlights; ++seed) {
    LongFlight flight(kLength_s, 0.5, seed);
    flight.fly_until(kVisit_s + 30.0);
    at_first += flight.squared_deviation() / kFlights;
    flight.fly_until(kLength_s);
    at_last += flight.squared_deviation() / kFlights;
  }
  EXPECT_LT(at_first, most_by_chance(kFlights));
  EXPECT_LT(at_last, most_by_chance(kFlights));
}

TEST(LongFlights, FindWhatTheySawAtFirstAgainAfterAnHour) {
  constexpr int kFlights = 1;
  double at_last = 0.0;
  for (unsigned seed = 1; seed <= kFlights; ++seed) {
    LongFlight flight(kHour_s, 1.0, seed);
    flight.fly_until(kVisit_s);
    const std::vector<std::uint64_t> at_first = ids_of(flight, kFirst);
    flight.fly_until(kHour_s);
    EXPECT_EQ(ids_of(flight, kFirst), at_first);
    EXPECT_EQ(flight.flight().tracks().size(), all_places().size());
    for (const std::uint64_t id : ids_of(flight, all_places())) EXPECT_NE(id, 0U);
    at_last += flight.squared_deviation() / kFlights;
  }
  EXPECT_LT(at_last, most_by_chance(kFlights));
}

/// Whatever the head would need more room for, were it not bounded: nodes, spells, and steps of the state,
/// which no node across them stands for.
TEST(LongFlights, AllocateNothing) {
  const Path told = [](double time_s) {
    Pose pose = as_planned(time_s, kHour_s);
    pose.position.x() += std::fmod(time_s, 200.0) < 100.0 ? 0.0 : 6.0;
    return pose;
  };
  NadirFlight flight({}, told, [](double time_s) { return as_planned(time_s, kHour_s); });
  std::vector<FrameDetections> frames;
  for (int i = 1; i < static_cast<int>(kHour_s); ++i) {
    FrameDetections frame;
    frame.captured_at = testing::at_s(i);
    frame.captured_at_host = testing::host_at_s(i);
    for (const Eigen::Vector3d& place : all_places()) {
      if (const auto pixel = flight.shown_point(i, place))
        frame.detections.push_back(testing::box_at(*pixel));
    }
    frames.push_back(frame);
  }
  flight.fly_until(0.0);
  const std::size_t before = testing::allocations();
  for (const FrameDetections& frame : frames) {
    flight.fly_until(seconds(frame.captured_at.time_since_epoch()));
    EXPECT_TRUE(flight.geolocator().process(frame));
  }
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_GE(flight.geolocator().state().steps().segment, 30U);
  EXPECT_EQ(flight.tracks().size(), all_places().size());
}

}  // namespace
}  // namespace geoloc
