// SPDX-License-Identifier: Apache-2.0
#include "geoloc/pipeline/geolocator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <random>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "support/allocation_counter.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::at_s;
using testing::box_at;
using testing::NadirFlight;
using testing::Pose;

constexpr double kSpeed_mps = 5.0;
constexpr double kHeight_m = 20.0;

/// To the north, pitched up a little and rolling.
Pose rolling_northwards(double time_s) {
  return {{0.0, kSpeed_mps * time_s, kHeight_m}, 0.05 * std::sin(time_s), 0.03, 0.0};
}

struct SeenObject {
  Eigen::Vector2d place, pixel;
};

/// A flight over objects on a grid, with perfect telemetry: vehicle and pixels in closed form.
class Flight : public NadirFlight {
 public:
  explicit Flight(const GeolocatorConfig& config = {}) : NadirFlight(config, rolling_northwards) {}

  /// Those of the grid in view.
  std::vector<SeenObject> seen(double time_s) const {
    std::vector<SeenObject> objects;
    for (double north = 0; north < 200; north += 8.0) {
      for (const double east : {-8.0, 0.0, 7.0}) {
        if (const auto pixel = shown(time_s, {east, north})) objects.push_back({{east, north}, *pixel});
      }
    }
    return objects;
  }

  /// What a perfect detector sees at that time.
  std::vector<Detection> boxes(double time_s) const {
    std::vector<Detection> detections;
    for (const SeenObject& object : seen(time_s)) detections.push_back(box_at(object.pixel));
    return detections;
  }
};

// --- One frame, against closed forms.

TEST(GeolocatorPose, OfVehicleAndCameraAreThoseOfTheTelemetry) {
  const testing::Path path = [](double time_s) {
    return Pose{{3.0 * time_s, -2.0 * time_s, 30.0 + 0.5 * time_s}, 0.2, -0.15, 2.0};
  };
  NadirFlight flight({}, path);
  flight.process(2.05, {});  // between two samples
  const FrameView& view = flight.geolocator().view();
  EXPECT_EQ(view.vehicle.time, at_s(2.05));
  EXPECT_EQ(view.captured_at_host, testing::host_at_s(2.05));
  EXPECT_LT((view.vehicle.enu_from_body.translation - Eigen::Vector3d(6.15, -4.1, 31.025)).norm(), 1e-3);
  EXPECT_LT((view.vehicle.velocity_in_enu - Eigen::Vector3d(3.0, -2.0, 0.5)).norm(), 1e-3);
  // Columns of Rz(2) Ry(-0.15) Rx(0.2), in north-east-down.
  const double cr = std::cos(0.2), sr = std::sin(0.2), cp = std::cos(0.15), sp = -std::sin(0.15);
  const double cy = std::cos(2.0), sy = std::sin(2.0);
  const Eigen::Vector3d nose(sy * cp, cy * cp, sp);  // east, north, up: up is sine of the pitch
  const Eigen::Vector3d right(sr * sp * sy + cr * cy, sr * sp * cy - cr * sy, -sr * cp);
  const Eigen::Matrix3d body = view.vehicle.enu_from_body.rotation.toRotationMatrix();
  EXPECT_LT((body.col(0) - nose).norm(), 1e-5);
  EXPECT_LT((body.col(1) - right).norm(), 1e-5);
  // The camera's right is the vehicle's, its image's bottom the vehicle's tail.
  const Eigen::Matrix3d camera = view.enu_from_camera.rotation.toRotationMatrix();
  EXPECT_LT((camera.col(0) - right).norm(), 1e-5);
  EXPECT_LT((camera.col(1) + nose).norm(), 1e-5);
  EXPECT_LT((camera.col(2) - right.cross(Eigen::Vector3d(-nose))).norm(), 1e-5);
}

TEST(GeolocatorFixes, AreWhereTheObjectsAre) {
  for (const Pose& pose :
       {Pose{{0, 0, 20}, 0, 0, 0}, Pose{{0, 0, 35}, 0.3, -0.2, 2.1}, Pose{{0, 0, 60}, -0.1, 0.4, -1.0}}) {
    NadirFlight flight({}, [&](double) { return pose; });
    std::vector<Eigen::Vector2d> places;
    std::vector<Detection> detections;
    for (double east = -30.0; east < 31.0; east += 5.0) {
      for (double north = -30.0; north < 31.0; north += 5.0) {
        const auto pixel = flight.shown(1.0, {east, north});
        if (!pixel) continue;
        places.emplace_back(east, north);
        detections.push_back(box_at(*pixel));
        detections.back().confidence -= 1e-3 * static_cast<double>(places.size());  // the order of located()
      }
    }
    ASSERT_GE(places.size(), 9U);
    flight.process(1.0, detections);
    const std::vector<LocatedDetection>& located = flight.geolocator().located();
    ASSERT_EQ(located.size(), places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_LT((located[i].fix.position_in_enu - places[i]).norm(), 1e-3);
      const double range_m = std::hypot((places[i] - pose.position.head<2>()).norm(), pose.position.z());
      EXPECT_NEAR(located[i].fix.range_m, range_m, 1e-3);
    }
  }
}

/// Level, to the east, the camera tilted half way down, a metre before and half a metre below the vehicle.
TEST(GeolocatorFixes, OfATiltedCameraAreAheadOfIt) {
  GeolocatorConfig config;
  config.camera.mount.pitch_deg = -45.0;
  config.camera.mount.x_m = 1.0;
  config.camera.mount.z_m = 0.5;
  NadirFlight flight(config, [](double) { return Pose{{0, 0, 20.5}, 0, 0, kPi / 2}; });
  flight.process(1.0, {box_at({testing::kPrincipalX_px, testing::kPrincipalY_px})});
  ASSERT_EQ(flight.geolocator().located().size(), 1U);
  EXPECT_LT((flight.geolocator().located()[0].fix.position_in_enu - Eigen::Vector2d(21.0, 0.0)).norm(), 1e-3);
  // A pixel of 45 degrees to the right: as far aside as the ray is long.
  flight.process(1.1,
                 {box_at({testing::kPrincipalX_px + 0.5 * testing::kFocal_px, testing::kPrincipalY_px})});
  const Eigen::Vector2d aside(21.0, -0.5 * 20.0 * std::sqrt(2.0));
  EXPECT_LT((flight.geolocator().located()[0].fix.position_in_enu - aside).norm(), 1e-3);
}

TEST(GeolocatorFixes, AreOnTheGroundThatIsStated) {
  GeolocatorConfig config;
  config.projector.ground_height_above_home_m = 5.0;
  NadirFlight flight(config, testing::hovering_at({0, 0, 25.0}));
  flight.process(1.0, {box_at({testing::kPrincipalX_px + 100.0, testing::kPrincipalY_px - 50.0})});
  const Eigen::Vector2d expected(100.0 * 20.0 / testing::kFocal_px, 50.0 * 20.0 / testing::kFocal_px);
  EXPECT_LT((flight.geolocator().located()[0].fix.position_in_enu - expected).norm(), 1e-3);
}

TEST(GeolocatorFixes, ThatThereAreNoneOfAreCountedByTheReason) {
  GeolocatorConfig config;
  config.camera.mount.pitch_deg = 0.0;  // the horizon is the image's middle row
  NadirFlight flight(config, testing::hovering_at({0, 0, 20.0}));
  flight.process(1.0, {box_at({640, 100}), box_at({640, 200}), box_at({640, 400}), box_at({640, 600})});
  const auto& no_fix = flight.geolocator().counters().no_fix;
  EXPECT_EQ(no_fix[static_cast<std::size_t>(NoFix::kAboveHorizon)], 2U);
  EXPECT_EQ(no_fix[static_cast<std::size_t>(NoFix::kTooGrazing)], 1U);  // 2.5 degrees down
  EXPECT_EQ(flight.geolocator().located().size(), 1U);
  EXPECT_EQ(flight.geolocator().counters().detections, 4U);
  EXPECT_EQ(flight.geolocator().counters().frames_located, 1U);
}

// --- Whole flights.

TEST(Geolocator, FindsEveryObjectWhereItIs) {
  Flight flight;
  for (double time_s = 1.0; time_s < 30.0; time_s += 0.1) {
    ASSERT_TRUE(flight.process(time_s, flight.boxes(time_s)));
  }
  int confirmed = 0;
  for (const Track& track : flight.geolocator().tracks()) {
    if (track.status != TrackStatus::kConfirmed) continue;
    ++confirmed;
    const Eigen::Vector2d position = track.position_in_enu.mean;
    const Eigen::Vector2d nearest{position.x() < -4 ? -8.0 : (position.x() < 3.5 ? 0.0 : 7.0),
                                  8.0 * std::round(position.y() / 8.0)};
    EXPECT_LT((position - nearest).norm(), 1e-3);
  }
  EXPECT_GE(confirmed, 3 * 18);
}

TEST(Geolocator, KeepsTwoObjectsHalfAMetreApartWhereBothWereSeenAtOnce) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    Flight flight;
    std::mt19937 random(seed);
    std::normal_distribution<double> noise_px(0.0, 1.5);
    std::bernoulli_distribution is_missed(0.2);
    int pairs = 0;
    for (double time_s = 1.0; time_s < 25.0; time_s += 0.1) {
      std::vector<Detection> detections;
      const double half_metre_px = 0.5 * testing::kFocal_px / kHeight_m;
      for (const SeenObject& object : flight.seen(time_s)) {
        for (const double aside_px : {0.0, half_metre_px}) {
          if (is_missed(random)) continue;
          const double u = object.pixel.x() + aside_px + noise_px(random),
                       v = object.pixel.y() + noise_px(random);
          detections.push_back(box_at({u, v}, 18.0));
        }
      }
      flight.process(time_s, std::move(detections));
    }
    std::vector<Eigen::Vector2d> objects;
    for (const Track& track : flight.geolocator().tracks()) {
      if (track.status == TrackStatus::kConfirmed) objects.push_back(track.position_in_enu.mean);
    }
    const auto is_found = [&](const Eigen::Vector2d& place) {
      return std::count_if(objects.begin(), objects.end(),
                           [&](const Eigen::Vector2d& object) { return (object - place).norm() < 0.2; }) == 1;
    };
    for (double north = 8.0; north < 80.0; north += 8.0) {
      for (const double east : {-8.0, 0.0, 7.0}) {
        EXPECT_TRUE(is_found({east, north}) && is_found({east + 0.5, north}))
            << seed << ": " << east << " " << north;
        ++pairs;
      }
    }
    EXPECT_GE(pairs, 27);
  }
}

/// One object of the grid, by a detector that knows centres to 0.2 px; moved by `aside_m` from then on.
std::vector<Detection> one_object(const Flight& flight, double time_s, double aside_m) {
  if (!flight.shown(time_s, {0.0, 40.0})) return {};
  Detection box = box_at(*flight.shown(time_s, {aside_m, 40.0}, 0.0));
  box.sigma_px = 0.2;
  return {box};
}

/// A flight over that object, moved by aside_m(time): it stays one object, and nearly all looks are used.
/// From an early begin on there are 150 empty frames before: then solutions have become rare.
template <class Aside>
void expect_one_object(Aside aside_m, double begin_s = 4.0) {
  Flight flight;
  std::size_t looks = 0;
  for (double time_s = begin_s; time_s < 12.0; time_s += time_s < 4.0 ? 0.02 : 0.1) {
    const std::vector<Detection> detections = one_object(flight, time_s, aside_m(time_s));
    looks += detections.size();
    flight.process(time_s, detections);
  }
  ASSERT_GT(looks, 25U);
  int objects = 0;
  for (const Track& track : flight.geolocator().tracks()) {
    if (track.status != TrackStatus::kConfirmed) continue;
    ++objects;
    EXPECT_GT(track.hits, static_cast<int>(looks) - 6);
  }
  EXPECT_EQ(objects, 1);
}

/// A jump in the vehicle's position estimate moves all that is seen: what was there before is still there.
TEST(Geolocator, KeepsAnObjectThatAJumpOfTheVehiclesPositionMovesAside) {
  for (const double aside_m : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}) {
    SCOPED_TRACE(aside_m);
    for (const double jump_s : {7.0, 7.5, 8.0, 8.5}) {
      SCOPED_TRACE(jump_s);
      const auto jump = [&](double time_s) { return time_s < jump_s ? 0.0 : aside_m; };
      expect_one_object(jump);
      expect_one_object(jump, 1.0);
    }
  }
}

/// The vehicle's position is noisier than the detector: lone looks at one object scatter, and some begin
/// another.
TEST(Geolocator, MakesOneObjectOfLooksThatScatterMoreThanTheirSigma) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 10U}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> aside_m(0.0, 0.1);
    expect_one_object([&](double) { return aside_m(random); });
  }
}

Eigen::Vector2d offset_of_pair(double north_m, double apart_m) {
  const double direction = std::round(north_m / 8.0);  // [rad]
  return apart_m * Eigen::Vector2d(std::cos(direction), std::sin(direction));
}

/// What a detector that takes near neighbours for one object while they are ahead of the vehicle sees: the
/// grid's middle column is pairs, in all directions.
std::vector<Detection> with_pairs(const Flight& flight, double time_s, double apart_m, std::mt19937& random) {
  std::normal_distribution<double> noise_px(0.0, 1.0);
  std::vector<Detection> detections;
  for (const SeenObject& object : flight.seen(time_s)) {
    const bool is_pair = object.place.x() == 0.0;
    const bool is_resolved = object.pixel.y() > 360.0;
    std::vector<double> shares{0.0};
    if (is_pair && is_resolved) shares = {-0.5, 0.5};
    for (const double share : shares) {
      const Eigen::Vector2d place = object.place + share * offset_of_pair(object.place.y(), apart_m);
      const Eigen::Vector2d pixel = *flight.shown(time_s, place, 0.0);
      const double u = pixel.x() + noise_px(random), v = pixel.y() + noise_px(random);
      detections.push_back(box_at({u, v}));
    }
  }
  return detections;
}

TEST(Geolocator, SplitsAnObjectThatTurnsOutToBeTwo) {
  double sum_of_squares = 0.0;
  int count = 0;
  for (const double apart_m : {0.5, 0.65, 0.8}) {  // the detector's boxes are 0.65 m wide
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
      Flight flight;
      std::mt19937 random(seed);
      for (double time_s = 1.0; time_s < 25.0; time_s += 0.1)
        flight.process(time_s, with_pairs(flight, time_s, apart_m, random));
      for (double north = 16.0; north < 80.0; north += 8.0) {
        const Eigen::Vector2d half = 0.5 * offset_of_pair(north, apart_m);
        std::vector<Eigen::Vector2d> found;
        for (const Track& track : flight.geolocator().tracks()) {
          const Eigen::Vector2d from_middle = track.position_in_enu.mean - Eigen::Vector2d(0.0, north);
          if (track.status == TrackStatus::kConfirmed && from_middle.norm() < 3.0)
            found.push_back(from_middle);
        }
        ASSERT_EQ(found.size(), 2U) << apart_m << " m, seed " << seed << ", " << north;
        const auto squares = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
          return (found[0] - a).squaredNorm() + (found[1] - b).squaredNorm();
        };
        sum_of_squares += std::min(squares(half, -half), squares(-half, half));
        count += 2;
      }
    }
  }
  // 0.16 m where the older of the two keeps the looks at both.
  EXPECT_LT(std::sqrt(sum_of_squares / count), 0.1);
}

constexpr int kCar = 2;

/// One drives along with the vehicle, one crosses its way.
std::vector<Eigen::Vector2d> cars_at(double time_s) {
  return {{3.0, 20.0 + 4.0 * time_s}, {-10.0 + 3.0 * (time_s - 13.0), 75.0}};
}

GeolocatorConfig with_moving_cars() {
  GeolocatorConfig config;
  config.joint.moving.classes = {kCar};
  return config;
}

/// The static grid with the detector's noise, and the cars if wanted.
std::vector<Detection> with_cars(const Flight& flight, double time_s, bool cars, std::mt19937& random) {
  std::normal_distribution<double> noise_px(0.0, 1.0);
  std::vector<Detection> detections = flight.boxes(time_s);
  for (Detection& detection : detections) {
    detection.box.x += noise_px(random);
    detection.box.y += noise_px(random);
  }
  if (!cars) return detections;
  std::mt19937 random_of_cars(static_cast<unsigned>(std::lround(time_s * 10.0)));
  for (const Eigen::Vector2d& car : cars_at(time_s)) {
    const auto pixel = flight.shown(time_s, car, 40.0);
    if (!pixel) continue;
    const double u = pixel->x() + noise_px(random_of_cars), v = pixel->y() + noise_px(random_of_cars);
    detections.push_back(box_at({u, v}, 60.0, kCar));
    detections.back().confidence = 0.8;
  }
  return detections;
}

TEST(Geolocator, TellsWhereAndHowFastMovingObjectsWere) {
  Flight flight(with_moving_cars());
  std::mt19937 random(5);
  for (double time_s = 1.0; time_s < 30.0; time_s += 0.1)
    flight.process(time_s, with_cars(flight, time_s, true, random));
  std::vector<Track> found;
  for (const Track& track : flight.geolocator().tracks()) {
    if (track.class_id() == kCar && track.status == TrackStatus::kConfirmed) found.push_back(track);
  }
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const double last_seen_s = seconds(found[i].last_seen.time_since_epoch()) - 1e9;
    const Eigen::Vector2d place = cars_at(last_seen_s)[i];
    const Eigen::Vector2d velocity = (cars_at(last_seen_s + 1.0)[i] - place);
    EXPECT_LT((found[i].position_in_enu.mean - place).norm(), 0.15) << i;
    ASSERT_TRUE(found[i].velocity_in_enu) << i;
    EXPECT_LT((found[i].velocity_in_enu->mean - velocity).norm(), 0.3) << i;
  }
}

TEST(Geolocator, LearnsTheSameOfAllElseWhetherThingsMoveThroughThePictureOrNot) {
  Flight with(with_moving_cars()), without(with_moving_cars());
  std::mt19937 random_with(5), random_without(5);
  for (double time_s = 1.0; time_s < 30.0; time_s += 0.1) {
    with.process(time_s, with_cars(with, time_s, true, random_with));
    without.process(time_s, with_cars(without, time_s, false, random_without));
  }
  EXPECT_EQ(with.geolocator().calibration()->mean, without.geolocator().calibration()->mean);
  std::vector<Eigen::Vector2d> still_with, still_without;
  for (const Track& track : with.geolocator().tracks()) {
    if (!track.velocity_in_enu && track.class_id() != kCar) still_with.push_back(track.position_in_enu.mean);
  }
  for (const Track& track : without.geolocator().tracks())
    still_without.push_back(track.position_in_enu.mean);
  EXPECT_EQ(still_with, still_without);
}

TEST(Geolocator, DoesNotMindTheOrderOfDetections) {
  Flight straight, shuffled;
  std::mt19937 random(11);
  for (double time_s = 1.0; time_s < 20.0; time_s += 0.1) {
    std::vector<Detection> detections = straight.boxes(time_s);
    for (Detection& detection : detections) {
      detection.box.x += std::normal_distribution<double>(0.0, 3.0)(random);
    }
    straight.process(time_s, detections);
    std::shuffle(detections.begin(), detections.end(), random);
    shuffled.process(time_s, detections);
  }
  const auto& a = straight.geolocator().tracks();
  const auto& b = shuffled.geolocator().tracks();
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 20U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_EQ(a[i].position_in_enu.mean, b[i].position_in_enu.mean);  // the same bits
    EXPECT_EQ(a[i].position_in_enu.covariance, b[i].position_in_enu.covariance);
  }
}

/// A detector without non-maximum suppression; sorting must not mind.
TEST(Geolocator, MakesOneObjectOfABoxHoweverOftenItIsListed) {
  Flight flight;
  std::vector<Detection> all_over;
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 20; ++column) {
      all_over.push_back(box_at({100.0 + 50.0 * column, 100.0 + 50.0 * row}));
      all_over.back().confidence = 0.95;
    }
  }
  flight.process(1.0, all_over);
  const Detection box = box_at({300.0, 200.0});
  flight.process(1.1, std::vector<Detection>(100, box));
  const auto& located = flight.geolocator().located();
  ASSERT_EQ(located.size(), 100U);
  for (const LocatedDetection& one : located) EXPECT_EQ(one.detection.box.centre(), box.box.centre());
  Flight alone;
  alone.process(1.1, std::vector<Detection>(100, box));
  EXPECT_EQ(alone.tracks().size(), 1U);
}

TEST(Geolocator, GuessesNothingWithoutState) {
  Flight flight;
  flight.fly_until(1.0);
  FrameDetections frame;
  frame.detections = flight.boxes(1.0);
  frame.captured_at = at_s(500.0);
  EXPECT_EQ(flight.geolocator().missing_state(frame.captured_at), NoState::kNotYet);
  EXPECT_FALSE(flight.geolocator().process(frame));
  EXPECT_EQ(flight.geolocator().counters().frames_unusable, 1U);
  EXPECT_TRUE(flight.geolocator().tracks().empty());
}

TEST(Geolocator, DoesNotUseBoxesThatTheImagesEdgeMayHaveCut) {
  const std::vector<Detection> boxes = {{{0, 100, 30, 30}, 0.9, 0},
                                        {{100, 1.9, 30, 30}, 0.9, 0},
                                        {{1250, 300, 30, 30}, 0.9, 0},
                                        {{500, 689, 30, 30}, 0.9, 0},
                                        {{1247, 687.5, 30, 30}, 0.9, 0}};
  for (const double edge_margin_px : {2.0, 0.0}) {
    GeolocatorConfig config;
    config.edge_margin_px = edge_margin_px;
    Flight flight(config);
    flight.process(1.0, boxes);
    EXPECT_EQ(flight.geolocator().counters().detections_at_edge, edge_margin_px > 0.0 ? 4U : 0U);
    EXPECT_EQ(flight.geolocator().located().size(), edge_margin_px > 0.0 ? 1U : 5U);
  }
}

TEST(Geolocator, CountsDetectionsItCannotUse) {
  GeolocatorConfig config;
  config.max_detections = 2;
  Flight flight(config);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  flight.process(1.0, {{{100, 100, 30, 30}, 0.5, 0},
                       {{nan, 0, 1, 1}, 0.9, 0},
                       {{0, 0, 0, 10}, 0.9, 0},
                       {{200, 300, 30, 30}, 0.9, 0, nan},
                       {{300, 300, 30, 30}, 0.9, 0, -1.0},
                       {{400, 300, 30, 30}, 0.9, 0, 1e-9},
                       {{500, 300, 30, 30}, 0.9, 0},
                       {{700, 300, 30, 30}, 0.8, 0}});
  EXPECT_EQ(flight.geolocator().counters().detections_dropped, 6U);
  ASSERT_EQ(flight.geolocator().located().size(), 2U);  // the two most confident
  EXPECT_DOUBLE_EQ(flight.geolocator().located()[0].detection.confidence, 0.9);
  EXPECT_DOUBLE_EQ(flight.geolocator().located()[1].detection.confidence, 0.8);
}

TEST(Geolocator, TrustsADetectionAsFarAsItTrustsItself) {
  // What a detector states is corrected by what it shows: it is as noisy here as it states.
  const auto final_sigma_m = [](Method method, double sigma_px, double noise_px) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    GeolocatorConfig config;
    config.method = method;
    Flight flight(config);
    for (double time_s = 1.0; time_s < 15.0; time_s += 0.1) {
      std::vector<Detection> detections = flight.boxes(time_s);
      for (Detection& detection : detections) {
        detection.sigma_px = sigma_px;
        detection.box.x += noise_px * normal(random);
        detection.box.y += noise_px * normal(random);
      }
      flight.process(time_s, detections);
    }
    double sum_m = 0.0;
    for (const Track& track : flight.geolocator().tracks())
      sum_m += std::sqrt(track.position_in_enu.covariance.trace());
    return sum_m / static_cast<double>(flight.geolocator().tracks().size());
  };
  for (const Method method : {Method::kPaper, Method::kJoint}) {
    EXPECT_GT(final_sigma_m(method, 40.0, 40.0), 1.1 * final_sigma_m(method, 1.0, 1.0));
    EXPECT_GT(final_sigma_m(method, 100.0, 100.0), 1.1 * final_sigma_m(method, 40.0, 40.0));
  }
  const double configured_px = JointTrackerConfig{}.sigma_px;
  EXPECT_EQ(final_sigma_m(Method::kJoint, 0.0, 1.0), final_sigma_m(Method::kJoint, configured_px, 1.0))
      << "not stated";
}

/// A detector that is noisy, misses, fires twice, takes near neighbours for one and sees what is not there.
std::vector<Detection> hard_frame(const Flight& flight, double time_s, std::mt19937& random) {
  std::normal_distribution<double> noise_px(0.0, 6.0);
  std::uniform_real_distribution<double> anywhere(60.0, 660.0);
  std::vector<Detection> detections = with_cars(flight, time_s, true, random);
  for (const Detection& pair : with_pairs(flight, time_s, 0.6, random)) detections.push_back(pair);
  for (Detection& detection : detections) detection.box.x += noise_px(random);
  for (int i = 0; i < 3; ++i) detections.push_back(box_at({anywhere(random), anywhere(random)}, 30.0, i));
  std::shuffle(detections.begin(), detections.end(), random);
  detections.resize(detections.size() - std::min<std::size_t>(detections.size(), random() % 4));
  return detections;
}

/// From the first call on, but for new objects where there are more than ever before.
TEST(Geolocator, DoesNotAllocate) {
  for (const Method method : {Method::kJoint, Method::kPaper}) {
    GeolocatorConfig config = with_moving_cars();
    config.method = method;
    for (const double north : {8.0, 16.0, 24.0}) {
      KnownPoint point;
      point.position = testing::geodetic_of({-8.0, north});
      config.known_points.push_back(point);
    }
    Flight flight(config);
    std::mt19937 random(5);
    std::vector<FrameDetections> frames;
    for (double time_s = 1.0; time_s < 15.0; time_s += 0.1)
      frames.push_back({at_s(time_s), testing::host_at_s(time_s), hard_frame(flight, time_s, random)});
    flight.fly_until(15.0);
    std::size_t before = testing::allocations(), for_new_objects = 0;
    for (const FrameDetections& frame : frames) {
      const std::uint64_t created = flight.geolocator().track_counters().created;
      EXPECT_TRUE(flight.geolocator().process(frame));
      if (flight.geolocator().track_counters().created > created)
        for_new_objects += testing::allocations() - std::exchange(before, testing::allocations());
      EXPECT_EQ(testing::allocations(), before) << static_cast<int>(method);
    }
    EXPECT_LT(for_new_objects, 20U) << static_cast<int>(method);
    PositionSample position;
    position.time = at_s(100.0);
    position.position = testing::geodetic_of({0.0, 0.0});
    flight.geolocator().add(position);
    flight.geolocator().add(AttitudeSample{at_s(100.0), {}});
    EXPECT_EQ(testing::allocations(), before) << static_cast<int>(method);
    EXPECT_GT(flight.geolocator().track_counters().created, 20U);
    EXPECT_TRUE(method == Method::kPaper || flight.geolocator().track_counters().removed > 10U);
  }
}

TEST(GeolocatorConfig, NamesTheProblemsOfEveryStage) {
  GeolocatorConfig config;
  config.camera.intrinsics.width_px = -1;
  config.state.max_gap_s = 0;
  config.projector.max_range_m = -5;
  config.paper.gate = 0;
  config.max_detections = 0;
  EXPECT_EQ(config.problems().size(), 5U);
  EXPECT_THROW(Geolocator{config}, std::invalid_argument);
}

}  // namespace
}  // namespace geoloc
