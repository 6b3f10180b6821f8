// SPDX-License-Identifier: Apache-2.0
#include "geoloc/pipeline/geolocator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <random>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/state/state_provider.hpp"
#include "support/allocation_counter.hpp"

namespace geoloc {
namespace {

constexpr double kSpeed_mps = 5.0;
constexpr double kHeight_m = 20.0;
const Geodetic kHome{-22.906, -43.133};

VehicleTime at_s(double s) {
  return VehicleTime{from_seconds(s)};
}

/// A level flight to the north over objects on a grid, with perfect telemetry.
class Flight {
 public:
  explicit Flight(const GeolocatorConfig& config = {}) : geolocator_(config) {}

  void fly_until(double time_s) {
    for (; telemetry_s_ < time_s + 0.2; telemetry_s_ += 0.1) {
      PositionSample position;
      position.time = at_s(telemetry_s_);
      position.position = frame_.to_geodetic({0.0, kSpeed_mps * telemetry_s_});
      position.height_above_home_m = kHeight_m;
      position.height_msl_m = kHeight_m + 10.0;
      geolocator_.add(position);
      geolocator_.add(AttitudeSample{at_s(telemetry_s_), {0.05 * std::sin(telemetry_s_), 0.03, 0.0}});
    }
  }

  /// What a perfect detector sees at that time.
  FrameDetections frame(double time_s) {
    fly_until(time_s);
    FrameDetections frame;
    frame.captured_at = at_s(time_s);
    frame.captured_at_host = HostTime{from_seconds(1e9 + time_s)};
    const auto state = geolocator_.state().at(frame.captured_at);
    const Rigid3d pose = enu_from_camera(*state, CameraMount{}, CameraOrientation::kComposed);
    for (double north = 0; north < 200; north += 8.0) {
      for (const double east : {-8.0, 0.0, 7.0}) {
        const auto pixel = geolocator_.projector().reproject({east, north}, pose);
        if (!pixel || !geolocator_.projector().camera().contains(*pixel, 20.0)) continue;
        frame.detections.push_back({{pixel->x() + 0.5 - 18, pixel->y() + 0.5 - 18, 36, 36}, 0.9, 0});
      }
    }
    return frame;
  }

  Geolocator& geolocator() { return geolocator_; }

 private:
  LocalFrame frame_{kHome, 10.0};
  Geolocator geolocator_;
  double telemetry_s_ = 0.0;
};

TEST(Geolocator, FindsEveryObjectWhereItIs) {
  Flight flight;
  for (double time_s = 1.0; time_s < 30.0; time_s += 0.1)
    ASSERT_TRUE(flight.geolocator().process(flight.frame(time_s)));
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
      FrameDetections frame = flight.frame(time_s);
      const std::vector<Detection> grid = std::exchange(frame.detections, {});
      const double half_metre_px =
          0.5 * flight.geolocator().projector().camera().intrinsics().fx_px / kHeight_m;
      for (const Detection& detection : grid) {
        for (const double aside_px : {0.0, half_metre_px}) {
          if (is_missed(random)) continue;
          const Eigen::Vector2d centre = detection.box.centre() + Eigen::Vector2d(aside_px, 0.0);
          frame.detections.push_back({{centre.x() + 0.5 - 9.0 + noise_px(random),
                                       centre.y() + 0.5 - 9.0 + noise_px(random), 18.0, 18.0},
                                      0.9,
                                      0});
        }
      }
      flight.geolocator().process(frame);
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
FrameDetections with_one_object(Flight& flight, double time_s, double aside_m) {
  FrameDetections frame = flight.frame(time_s);
  const std::vector<Detection> grid = std::exchange(frame.detections, {});
  const auto view = enu_from_camera(*flight.geolocator().state().at(frame.captured_at), CameraMount{},
                                    CameraOrientation::kComposed);
  const auto pixel = flight.geolocator().projector().reproject({aside_m, 40.0}, view);
  const Eigen::Vector2d nominal{0.0, 40.0};
  for (const Detection& detection : grid) {
    const auto fix = flight.geolocator().projector().project(detection.box.centre(), view);
    if ((fix->position_in_enu - nominal).norm() > 1.0 || !pixel) continue;
    frame.detections.push_back({{pixel->x() + 0.5 - 18, pixel->y() + 0.5 - 18, 36, 36}, 0.9, 0, 0.2});
  }
  return frame;
}

/// A flight over that object, moved by aside_m(time): it stays one object, and nearly all looks are used.
/// From an early begin on there are 150 empty frames before: then solutions have become rare.
template <class Aside>
void expect_one_object(Aside aside_m, double begin_s = 4.0) {
  Flight flight;
  std::size_t looks = 0;
  for (double time_s = begin_s; time_s < 12.0; time_s += time_s < 4.0 ? 0.02 : 0.1) {
    const FrameDetections frame = with_one_object(flight, time_s, aside_m(time_s));
    looks += frame.detections.size();
    flight.geolocator().process(frame);
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

/// A frame in which a detector that takes near neighbours for one object while they are ahead of the vehicle
/// sees each place of the grid: the middle column's are pairs, in all directions.
FrameDetections with_pairs(Flight& flight, double time_s, double apart_m, std::mt19937& random) {
  std::normal_distribution<double> noise_px(0.0, 1.0);
  FrameDetections frame = flight.frame(time_s);
  const std::vector<Detection> grid = std::exchange(frame.detections, {});
  const auto view = enu_from_camera(*flight.geolocator().state().at(frame.captured_at), CameraMount{},
                                    CameraOrientation::kComposed);
  for (const Detection& detection : grid) {
    const auto fix = flight.geolocator().projector().project(detection.box.centre(), view);
    const bool is_pair = std::abs(fix->position_in_enu.x()) < 1.0;
    const bool is_resolved = detection.box.centre().y() > 360.0;
    std::vector<double> shares{0.0};
    if (is_pair) shares = is_resolved ? std::vector<double>{-0.5, 0.5} : std::vector<double>{0.0};
    for (const double share : shares) {
      const Eigen::Vector2d place =
          fix->position_in_enu + share * offset_of_pair(fix->position_in_enu.y(), apart_m);
      const auto pixel = flight.geolocator().projector().reproject(place, view);
      frame.detections.push_back({{pixel->x() + 0.5 - 18.0 + noise_px(random),
                                   pixel->y() + 0.5 - 18.0 + noise_px(random), 36.0, 36.0},
                                  0.9,
                                  0});
    }
  }
  return frame;
}

TEST(Geolocator, SplitsAnObjectThatTurnsOutToBeTwo) {
  double sum_of_squares = 0.0;
  int count = 0;
  for (const double apart_m : {0.5, 0.65, 0.8}) {  // the detector's boxes are 0.65 m wide
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
      Flight flight;
      std::mt19937 random(seed);
      for (double time_s = 1.0; time_s < 25.0; time_s += 0.1)
        flight.geolocator().process(with_pairs(flight, time_s, apart_m, random));
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
FrameDetections with_cars(Flight& flight, double time_s, bool cars, std::mt19937& random) {
  std::normal_distribution<double> noise_px(0.0, 1.0);
  FrameDetections frame = flight.frame(time_s);
  for (Detection& detection : frame.detections) {
    detection.box.x += noise_px(random);
    detection.box.y += noise_px(random);
  }
  if (!cars) return frame;
  const Projector& projector = flight.geolocator().projector();
  const auto view = enu_from_camera(*flight.geolocator().state().at(frame.captured_at), CameraMount{},
                                    CameraOrientation::kComposed);
  std::mt19937 random_of_cars(static_cast<unsigned>(std::lround(time_s * 10.0)));
  for (const Eigen::Vector2d& car : cars_at(time_s)) {
    const auto pixel = projector.reproject(car, view);
    if (!pixel || !projector.camera().contains(*pixel, 40.0)) continue;
    const double u = pixel->x() + 0.5 + noise_px(random_of_cars),
                 v = pixel->y() + 0.5 + noise_px(random_of_cars);
    frame.detections.push_back({{u - 30.0, v - 30.0, 60.0, 60.0}, 0.8, kCar});
  }
  return frame;
}

TEST(Geolocator, TellsWhereAndHowFastMovingObjectsWere) {
  Flight flight(with_moving_cars());
  std::mt19937 random(5);
  for (double time_s = 1.0; time_s < 30.0; time_s += 0.1)
    flight.geolocator().process(with_cars(flight, time_s, true, random));
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
    with.geolocator().process(with_cars(with, time_s, true, random_with));
    without.geolocator().process(with_cars(without, time_s, false, random_without));
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
    FrameDetections frame = straight.frame(time_s);
    for (Detection& detection : frame.detections) {
      detection.box.x += std::normal_distribution<double>(0.0, 3.0)(random);
    }
    straight.geolocator().process(frame);
    std::shuffle(frame.detections.begin(), frame.detections.end(), random);
    shuffled.fly_until(time_s);
    shuffled.geolocator().process(frame);
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

TEST(Geolocator, GuessesNothingWithoutState) {
  Flight flight;
  FrameDetections frame = flight.frame(1.0);
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
    FrameDetections frame = flight.frame(1.0);
    frame.detections = boxes;
    flight.geolocator().process(frame);
    EXPECT_EQ(flight.geolocator().counters().detections_at_edge, edge_margin_px > 0.0 ? 4U : 0U);
    EXPECT_EQ(flight.geolocator().located().size(), edge_margin_px > 0.0 ? 1U : 5U);
  }
}

TEST(Geolocator, CountsDetectionsItCannotUse) {
  GeolocatorConfig config;
  config.max_detections = 2;
  Flight flight(config);
  FrameDetections frame = flight.frame(1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  frame.detections = {{{100, 100, 30, 30}, 0.5, 0},
                      {{nan, 0, 1, 1}, 0.9, 0},
                      {{0, 0, 0, 10}, 0.9, 0},
                      {{200, 300, 30, 30}, 0.9, 0, nan},
                      {{300, 300, 30, 30}, 0.9, 0, -1.0},
                      {{400, 300, 30, 30}, 0.9, 0, 1e-9},
                      {{500, 300, 30, 30}, 0.9, 0},
                      {{700, 300, 30, 30}, 0.8, 0}};
  flight.geolocator().process(frame);
  EXPECT_EQ(flight.geolocator().counters().detections_dropped, 6U);
  ASSERT_EQ(flight.geolocator().located().size(), 2U);  // the two most confident
  EXPECT_DOUBLE_EQ(flight.geolocator().located()[0].detection.confidence, 0.9);
  EXPECT_DOUBLE_EQ(flight.geolocator().located()[1].detection.confidence, 0.8);
}

TEST(Geolocator, TrustsADetectionAsFarAsItTrustsItself) {
  const auto final_sigma_m = [](Method method, double sigma_px) {
    GeolocatorConfig config;
    config.method = method;
    Flight flight(config);
    for (double time_s = 1.0; time_s < 15.0; time_s += 0.1) {
      FrameDetections frame = flight.frame(time_s);
      for (Detection& detection : frame.detections) detection.sigma_px = sigma_px;
      flight.geolocator().process(frame);
    }
    double sum_m = 0.0;
    for (const Track& track : flight.geolocator().tracks())
      sum_m += std::sqrt(track.position_in_enu.covariance.trace());
    return sum_m / static_cast<double>(flight.geolocator().tracks().size());
  };
  for (const Method method : {Method::kPaper, Method::kJoint}) {
    EXPECT_GT(final_sigma_m(method, 40.0), 1.1 * final_sigma_m(method, 1.0));
    EXPECT_GT(final_sigma_m(method, 200.0), 1.1 * final_sigma_m(method, 40.0));
  }
  const double configured_px = JointTrackerConfig{}.sigma_px;
  EXPECT_EQ(final_sigma_m(Method::kJoint, 0.0), final_sigma_m(Method::kJoint, configured_px)) << "not stated";
}

TEST(Geolocator, DoesNotAllocateInTheSteadyState) {
  Flight flight(with_moving_cars());
  std::mt19937 random(5);
  std::vector<FrameDetections> frames;
  for (double time_s = 1.0; time_s < 15.0; time_s += 0.1)
    frames.push_back(with_cars(flight, time_s, true, random));
  flight.geolocator().process(frames[0]);
  const std::size_t before = testing::allocations();
  for (const FrameDetections& frame : frames) flight.geolocator().process(frame);
  PositionSample position;
  position.time = at_s(100.0);
  position.position = kHome;
  flight.geolocator().add(position);
  flight.geolocator().add(AttitudeSample{at_s(100.0), {}});
  EXPECT_EQ(testing::allocations(), before);
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
