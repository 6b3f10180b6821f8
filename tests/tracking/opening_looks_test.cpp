// SPDX-License-Identifier: Apache-2.0
#include "tracking/opening_looks.hpp"
#include "support/landmark_position.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "calibration/noise.hpp"
#include "projection/camera_pose.hpp"
#include "support/nadir_flight.hpp"
#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

using Index = CalibrationIndex;
using testing::Pose;

constexpr double kGround_m = 1.5;
/// By which time the vehicle has reported for a while.
constexpr double kFirstFrame_s = 1.0;

FrameStamp stamp_at(double time_s) {
  return {testing::at_s(kFirstFrame_s + time_s), testing::host_at_s(kFirstFrame_s + time_s)};
}

/// A vehicle that flies over objects in circles and climbs, with a camera that looks down and a little ahead.
/// The frames are located with the calibration of their time, and looked at anew with that which was learnt
/// since.
class OpeningFrames : public ::testing::Test {
 protected:
  OpeningFrames() {
    ProjectorConfig config;
    config.ground_height_above_home_m = kGround_m;
    projector_ = Projector(config, CameraIntrinsics{});
    set_calibration({0.02, -0.03, 0.05}, 0.1, -0.6);
    for (double time_s = 0.0; time_s < 15.0; time_s += 0.1) report(time_s);
  }

  /// From the origin to the east, and on to the left.
  static Pose pose_at(double time_s) {
    const double turned = 0.4 * time_s;
    return {{8.0 * std::sin(turned), 8.0 - 8.0 * std::cos(turned), 20.0 + 0.2 * time_s},
            0.0,
            0.2,
            0.5 * 3.14159265358979323846 - turned};
  }

  void report(double time_s) {
    const Pose pose = pose_at(time_s);
    PositionSample position;
    position.time = testing::at_s(time_s);
    position.position = testing::geodetic_of(pose.position.head<2>());
    position.height_above_home_m = pose.position.z();
    position.height_msl_m = pose.position.z() + 10.0;
    state_.add(position);
    state_.add(AttitudeSample{testing::at_s(time_s), {pose.roll, pose.pitch, pose.yaw}});
  }

  void set_calibration(const Eigen::Vector3d& boresight, double latency_s, double height_m) {
    errors_.calibration.mean << boresight, latency_s, height_m, 0.0, 0.02, 0.3, -0.2;
  }

  std::optional<FrameView> nominal_view(double time_s, double latency_s, const StateProvider& state) const {
    const FrameStamp stamp = stamp_at(time_s);
    const auto vehicle = state.at(stamp.captured_at - from_seconds(latency_s));
    if (!vehicle) return std::nullopt;
    return FrameView{*vehicle,
                     enu_from_camera(*vehicle, mount_, CameraOrientation::kComposed),
                     stamp.captured_at_host,
                     0.0,
                     latency_s,
                     0.0,
                     turn_of(*vehicle)};
  }

  /// Located with the calibration as it is now; nullopt where the vehicle's state was never known then.
  std::optional<FrameView> view(double time_s) const {
    std::optional<FrameView> found = nominal_view(time_s, errors_.calibration.latency_s(), state_);
    if (!found && former_state_) found = nominal_view(time_s, former_latency_s_, *former_state_);
    if (!found) return std::nullopt;
    FrameView& view = *found;
    Rigid3d& pose = view.enu_from_camera;
    view.lifted_m = errors_.lift_m(pose.translation.z() - kGround_m);
    const Eigen::Vector3d boresight = errors_.calibration.boresight_rad();
    if (boresight.norm() > 0.0)
      pose.rotation = pose.rotation * Eigen::AngleAxisd(boresight.norm(), boresight.normalized());
    pose.translation += errors_.calibration.position_lag_s() * view.vehicle.velocity_in_enu;
    pose.translation.z() += view.lifted_m;
    return found;
  }

  static Detection detection_at(const Eigen::Vector2d& pixel) {
    Detection detection;
    detection.box = {pixel.x() + 0.5 - 20.0, pixel.y() + 0.5 - 20.0, 40.0, 40.0};
    return detection;
  }

  struct Sighting {
    double time_s;
    NodeSpan span;
    NoiseRepetition repetition;
    double looks_that_share;
    std::uint64_t track_id;
    Detection detection;
  };

  RestingObject& append(std::uint64_t track_id) {
    RestingObject& object = tracks_.append();
    object.track.id = track_id;
    object.prior = testing::ground_at(0.4);
    clear_sums(object);
    return object;
  }

  /// A frame that shows each of the objects somewhere.
  void see(double time_s, const std::vector<std::uint64_t>& track_ids) {
    std::vector<Eigen::Vector2d> pixels;
    for (const std::uint64_t id : track_ids)
      pixels.emplace_back(100.0 + 150.0 * static_cast<double>(id) + 10.0 * time_s,
                          600.0 - 90.0 * static_cast<double>(id));
    see(time_s, track_ids, pixels);
  }

  void see(double time_s, const std::vector<std::uint64_t>& track_ids,
           const std::vector<Eigen::Vector2d>& pixels) {
    const FrameView now = *view(time_s);
    const NodeSpan span = errors_.drift.cover(now.vehicle.time, 0.5);
    const NoiseRepetition repetition{3.0 + time_s, 2.0};
    const JointFrame frame{projector_, now, span, errors_.drift.at(span), repetition, 0.0, 0.1};
    const double share = 1.0 + std::fmod(time_s, 3.0);
    opening_looks_.begin_frame(stamp_at(time_s), frame, share);
    for (std::size_t i = 0; i < track_ids.size(); ++i) {
      const Detection detection = detection_at(pixels[i]);
      opening_looks_.add(track_ids[i], detection);
      seen_.push_back({time_s, span, repetition, share, track_ids[i], detection});
    }
  }

  /// The looks of the sightings that `is_its(sighting)` picks, made with what is known now.
  template <typename IsIts>
  Landmark landmark_of_those(const IsIts& is_its) {
    Landmark landmark;
    landmark.add_prior(testing::ground_at(0.4));
    looks_made_ = 0;
    for (const Sighting& sighting : seen_) {
      if (!is_its(sighting)) continue;
      const auto now = view(sighting.time_s);
      if (!now) continue;
      const auto fix = projector_.project(sighting.detection.box.centre(), now->enu_from_camera);
      if (!fix) continue;
      const JointFrame frame{
          projector_, *now, sighting.span, errors_.drift.at(sighting.span), sighting.repetition, 0.0, 0.1};
      landmark.add(
          maker_.make_look({sighting.detection, *fix}, sighting.looks_that_share, frame, errors_).observation,
          errors_.drift);
      ++looks_made_;
    }
    return landmark;
  }

  Landmark landmark_of(std::uint64_t track_id) {
    return landmark_of_those([&](const Sighting& sighting) { return sighting.track_id == track_id; });
  }

  void linearise_anew() {
    const FrameViewer viewer{state_, mount_, CameraOrientation::kComposed};
    opening_looks_.linearise_anew(viewer, projector_, maker_, errors_, tracks_, recent_);
  }

  static void expect_same(const Landmark& sums, const Landmark& expected) {
    EXPECT_TRUE(sums.A().isApprox(expected.A(), 1e-9));
    EXPECT_TRUE(sums.b().isApprox(expected.b(), 1e-9));
    EXPECT_TRUE(sums.B().isApprox(expected.B(), 1e-9) || expected.B().norm() == 0.0);
    EXPECT_TRUE(sums.C().isApprox(expected.C(), 1e-9) || expected.C().norm() == 0.0);
    EXPECT_TRUE(sums.g().isApprox(expected.g(), 1e-9) || expected.g().norm() == 0.0);
    ASSERT_EQ(sums.end() - sums.begin(), expected.end() - expected.begin());
    const Landmark::NodeTerms* other = expected.begin();
    for (const Landmark::NodeTerms& terms : sums) {
      EXPECT_EQ(terms.number, other->number);
      EXPECT_LT((terms.B - other->B).norm(), 1e-6);
      EXPECT_LT((terms.C_own - other->C_own).norm(), 1e-6);
      EXPECT_LT((terms.g - other->g).norm(), 1e-6);
      ++other;
    }
  }

  StateProvider state_{StateConfig{}};
  std::optional<StateProvider> former_state_;  // when frames were looked up by
  double former_latency_s_ = 0.0;              // this latency
  CameraMount mount_;
  Projector projector_{{}, CameraIntrinsics{}};
  JointTrackerConfig config_;
  LookMaker maker_{config_, 20};
  ArrowheadSolver solver_{CalibrationPrior{}, DriftConfig{}};
  SharedErrorEstimate errors_{PositionAccuracy{0.8, 0.2, 0.02, 0.02}, testing::kHeightPrior, testing::kNoise,
                              DriftConfig{}, solver_};
  TrackTable tracks_{10};
  OpeningLooks opening_looks_;
  RecentLooks recent_{20};
  std::vector<Sighting> seen_;
  int looks_made_ = 0;  // by the last landmark_of_those()
};

TEST_F(OpeningFrames, AreLinearisedAnewAsIfLocatedWithWhatIsKnownNow) {
  for (const std::uint64_t id : {1U, 2U, 3U}) append(id);
  for (double time_s = 0.0; time_s < 12.0; time_s += 0.7) {
    see(time_s, {1, 2, 3});
    set_calibration({0.02 + 0.001 * time_s, -0.03, 0.05}, 0.1 + 0.01 * time_s,
                    -0.6 - 0.1 * time_s);  // as it is learnt
  }
  set_calibration({-0.03, 0.01, -0.08}, 0.37, 6.5);
  errors_.drift.node(1).mean.setConstant(0.03);
  for (int round = 0; round < 2; ++round) {  // as often as one likes
    linearise_anew();
    for (const std::uint64_t id : {1U, 2U, 3U}) {
      expect_same(*tracks_.find(id)->landmark, landmark_of(id));
      EXPECT_EQ(looks_made_, 18);
    }
  }
}

/// Where a clock has stepped, they must be what the sums hold, and not what they were when they were new.
TEST_F(OpeningFrames, CanBeTakenOutAsTheyAreNow) {
  for (const std::uint64_t id : {1U, 2U, 3U}) append(id);
  for (double time_s = 0.0; time_s < 12.0; time_s += 0.7) see(time_s, {1, 2, 3});
  set_calibration({-0.03, 0.01, -0.08}, 0.37, 6.5);
  linearise_anew();
  recent_.take_out(VehicleTime{} + Duration{1}, errors_.drift, tracks_);
  for (const std::uint64_t id : {1U, 2U, 3U}) {
    const RestingObject& object = *tracks_.find(id);
    EXPECT_LT((object.landmark->A() - object.prior.matrix).norm(), 1e-9 * landmark_of(id).A().norm());
    EXPECT_LT((object.landmark->b() - object.prior.vector).norm(), 1e-9 * landmark_of(id).b().norm());
  }
}

/// The vehicle turns and climbs: the frames of a camera that is late show an object at its place only from
/// where the vehicle was, which no line through where it is tells. All but the latency is known.
TEST_F(OpeningFrames, ShowObjectsAtTheirPlacesOnceTheLatencyIsKnown) {
  constexpr double kLatency_s = 0.45;
  errors_.calibration.mean.setZero();
  const Eigen::Vector3d place(9.0, 8.0, kGround_m + 2.0);
  RestingObject& object = append(1);
  object.prior = testing::ground_at(0.0, 100.0);
  for (double time_s = 0.0; time_s < 12.0; time_s += 0.3) {
    const Pose truth = pose_at(kFirstFrame_s + time_s - kLatency_s);
    see(time_s, {1}, {*testing::pixel_of_point(place, truth)});
  }
  const auto miss_m = [&](double latency_s) {
    errors_.calibration.mean[Index::kLatency] = latency_s;
    linearise_anew();
    const Point found = position_of(*object.landmark, errors_.calibration.mean, errors_.drift);
    return (found + Point(0.0, 0.0, kGround_m) - place).norm();
  };
  EXPECT_GT(miss_m(0.0), 0.3);
  EXPECT_LT(miss_m(kLatency_s), 0.01);
  EXPECT_GT(miss_m(2.0 * kLatency_s), 0.3);
  EXPECT_LT(miss_m(kLatency_s), 0.01);
}

/// With a latency so long, the first frames show what was before the vehicle's first report.
TEST_F(OpeningFrames, AreLeftOutWhereTheVehiclesStateWasNeverKnown) {
  RestingObject& object = append(1);
  for (double time_s = 0.0; time_s < 10.0; time_s += 1.0) see(time_s, {1});
  for (const auto& [latency_s, known] : {std::pair{2.1, 8}, {0.1, 10}}) {
    errors_.calibration.mean[Index::kLatency] = latency_s;
    linearise_anew();
    expect_same(*object.landmark, landmark_of(1));
    EXPECT_EQ(looks_made_, known);
  }
}

/// The first of rarely taken frames are older than all that is kept of the vehicle's reports.
TEST_F(OpeningFrames, AreSeenFromWhereTheyWereOnceTheVehiclesStateIsKnownNoMore) {
  RestingObject& object = append(1);
  for (double time_s = 0.0; time_s < 10.0; time_s += 1.0) see(time_s, {1});
  linearise_anew();
  former_state_ = state_;
  former_latency_s_ = errors_.calibration.latency_s();
  for (double time_s = 15.0; time_s < 57.2; time_s += 0.1) report(time_s);
  set_calibration({-0.03, 0.01, -0.08}, 0.37, 2.5);
  const auto is_known = [&](double time_s) { return nominal_view(time_s, 0.37, state_).has_value(); };
  EXPECT_FALSE(is_known(3.0));
  EXPECT_TRUE(is_known(7.0));
  linearise_anew();
  expect_same(*object.landmark, landmark_of(1));
  EXPECT_EQ(looks_made_, 10);
}

TEST_F(OpeningFrames, SayOfObjectsThatTheyDoNotShowThatTheyAreAboutWhereTheyWere) {
  RestingObject& unseen = append(7);
  see(0.0, {1});  // gone since
  unseen.landmark->add_prior(testing::ground_at(9.0));
  linearise_anew();
  Landmark ground;
  ground.add_prior(testing::ground_at(0.4));
  ground.add_prior({0.01 * PointMatrix::Identity(), 0.01 * unseen.position_in_enu});  // 10 m, 1 sigma
  expect_same(*unseen.landmark, ground);
}

TEST_F(OpeningFrames, AreLeftOutFromBeforeAnObjectBeganAnew) {
  RestingObject& object = append(1);
  for (double time_s = 0.0; time_s < 10.0; time_s += 1.0) see(time_s, {1});
  // When a frame was taken to be decides, whatever the latency is now.
  object.sums_since = stamp_at(4.0).captured_at - from_seconds(errors_.calibration.latency_s());
  for (const double latency_s : {0.1, 0.9, -0.9}) {
    errors_.calibration.mean[Index::kLatency] = latency_s;
    linearise_anew();
    expect_same(*object.landmark,
                landmark_of_those([](const Sighting& sighting) { return sighting.time_s >= 4.0; }));
    EXPECT_EQ(looks_made_, 6);
  }
}

TEST_F(OpeningFrames, FollowATrackThatIsRenamed) {
  append(1);
  append(2);
  for (double time_s = 0.0; time_s < 6.0; time_s += 1.0) see(time_s, {1, 2, 3});
  opening_looks_.rename(3, 1);
  opening_looks_.rename(9, 2);  // another's
  linearise_anew();
  expect_same(*tracks_[0].landmark,
              landmark_of_those([](const Sighting& seen) { return seen.track_id != 2; }));
  expect_same(*tracks_[1].landmark, landmark_of(2));
}

TEST_F(OpeningFrames, AreLeftOutWhereTheirRaysMeetNoGround) {
  append(1);
  for (double time_s = 0.0; time_s < 6.0; time_s += 1.0) see(time_s, {1}, {{640.0, 600.0 - 110.0 * time_s}});
  set_calibration({1.2, 0.0, 0.0}, 0.1, 0.0);  // turned up: some look at the sky
  linearise_anew();
  expect_same(*tracks_[0].landmark, landmark_of(1));
  EXPECT_GT(looks_made_, 0);
  EXPECT_LT(looks_made_, 6);
  set_calibration({2.5, 0.0, 0.0}, 0.1, 0.0);
  linearise_anew();
  EXPECT_EQ(tracks_[0].landmark->begin(), tracks_[0].landmark->end());
}

/// An object whose rays all miss the ground now is about where it was: it has a solution, and takes part in
/// the others'.
TEST_F(OpeningFrames, LeaveAnObjectInPlaceWhereNoneOfItsRaysMeetsTheGround) {
  append(1);
  for (double time_s = 0.0; time_s < 3.0; time_s += 1.0) see(time_s, {1}, {{640.0, 100.0}});
  tracks_[0].position_in_enu = {12.0, -7.0, 0.5};
  set_calibration({2.5, 0.0, 0.0}, 0.1, 0.0);
  linearise_anew();
  ASSERT_EQ(tracks_[0].landmark->begin(), tracks_[0].landmark->end());
  const Point place = position_of(*tracks_[0].landmark, errors_.calibration.mean, errors_.drift);
  EXPECT_LT((place - Point(12.0, -7.0, 0.5)).head<2>().norm(), 1e-9);
  EXPECT_TRUE(solver_.solve(tracks_.landmarks(), errors_.prior(), errors_.drift));
}

TEST_F(OpeningFrames, AreAHundredAtMost) {
  for (int frame = 0; frame < 100; ++frame) {
    see(0.1 * frame, {1});
    ASSERT_TRUE(opening_looks_.is_open()) << frame;
  }
  see(10.0, {});
  EXPECT_FALSE(opening_looks_.is_open());
  see(10.1, {1});  // is no concern of theirs any more
  opening_looks_.rename(1, 2);
  EXPECT_FALSE(opening_looks_.is_open());
}

TEST_F(OpeningFrames, EndWhenTheyAreTold) {
  see(0.0, {1});
  opening_looks_.close();
  EXPECT_FALSE(opening_looks_.is_open());
  see(0.1, {1});
  EXPECT_FALSE(opening_looks_.is_open());
}

TEST_F(OpeningFrames, ShowAThousandLooksAtMost) {
  for (int frame = 0; frame < 50; ++frame) {
    see(0.1 * frame, std::vector<std::uint64_t>(20, 1));
    ASSERT_TRUE(opening_looks_.is_open()) << frame;
  }
  see(5.0, {});
  ASSERT_TRUE(opening_looks_.is_open());
  see(5.1, {1});
  EXPECT_FALSE(opening_looks_.is_open());
}

}  // namespace
}  // namespace geoloc
