// SPDX-License-Identifier: Apache-2.0
#include "tracking/paper_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "geoloc/geometry/attitude.hpp"

namespace geoloc {
namespace {

/// A camera that looks straight down from 20 m over the origin: it sees 28 m x 15.7 m.
class PaperTrackerLife : public ::testing::Test {
 protected:
  void see(const std::vector<Eigen::Vector2d>& points, int class_id = 0) { see_at({0, 0}, points, class_id); }

  void see_at(const Eigen::Vector2d& vehicle, const std::vector<Eigen::Vector2d>& points, int class_id = 0) {
    const Rigid3d enu_from_body{enu_from_ned() * ned_from_body({}), {vehicle.x(), vehicle.y(), 20.0}};
    std::vector<LocatedDetection> detections;
    for (const Eigen::Vector2d& point : points) {
      LocatedDetection located{};
      located.detection.confidence = 0.9;
      located.detection.class_id = class_id;
      located.fix.position_in_enu = point;
      detections.push_back(located);
    }
    now_ += std::chrono::milliseconds{100};
    FrameView view;
    view.enu_from_camera = enu_from_body * body_from_camera(mount_);
    view.captured_at_host = now_;
    tracker_->update({detections, projector_, view, local_frame_, {}, viewer_, ground_, std::nullopt});
  }

  const std::vector<Track>& tracks() const { return tracker_->tracks(); }

  Projector projector_{ProjectorConfig{}, CameraIntrinsics{}};
  const GroundModel ground_{3.0};
  PaperTrackerConfig config_;
  LocalFrame local_frame_{Geodetic{}};
  const StateProvider state_{StateConfig{}};
  const CameraMount mount_{};
  const FrameViewer viewer_{state_, mount_, CameraOrientation::kComposed};
  std::optional<PaperTracker> tracker_{std::in_place, config_, 64};
  HostTime now_{std::chrono::seconds{1000}};
};

TEST_F(PaperTrackerLife, ConfirmsAnObjectAfterTheAskedHits) {
  for (int i = 1; i <= config_.confirm_hits; ++i) {
    see({{1, 2}});
    ASSERT_EQ(tracks().size(), 1U);
    const auto expected = i < config_.confirm_hits ? TrackStatus::kTentative : TrackStatus::kConfirmed;
    EXPECT_EQ(tracks()[0].status, expected);
  }
  EXPECT_EQ(tracks()[0].hits, config_.confirm_hits);
  EXPECT_EQ(tracks()[0].last_seen - tracks()[0].first_seen,
            std::chrono::milliseconds{100} * (config_.confirm_hits - 1));
}

TEST_F(PaperTrackerLife, AveragesNoiseDown) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int i = 0; i < 400; ++i) see({{3 + noise(random), -2 + noise(random)}});
  ASSERT_EQ(tracks().size(), 1U);
  EXPECT_LT((tracks()[0].position_in_enu.mean - Eigen::Vector2d(3, -2)).norm(), 0.25);
}

TEST_F(PaperTrackerLife, RemovesWhatShouldBeVisibleAndIsNot) {
  for (int i = 0; i < 6; ++i) see({{1, 2}});
  for (int i = 1; i < config_.max_penalty; ++i) see({});
  EXPECT_EQ(tracks().size(), 1U);
  see({});
  EXPECT_TRUE(tracks().empty());
}

TEST_F(PaperTrackerLife, KeepsWhatIsOutsideTheFieldOfView) {
  for (int i = 0; i < 6; ++i) see({{1, 2}});
  for (int i = 0; i < 10 * config_.max_penalty; ++i) see_at({100, 0}, {});
  ASSERT_EQ(tracks().size(), 1U);
  EXPECT_EQ(tracks()[0].penalty, 0);
}

TEST_F(PaperTrackerLife, HitsForgiveMisses) {
  for (int i = 0; i < 100; ++i)
    see(i % 2 == 0 ? std::vector<Eigen::Vector2d>{{1, 2}} : std::vector<Eigen::Vector2d>{});
  ASSERT_EQ(tracks().size(), 1U);
  EXPECT_LE(tracks()[0].penalty, 1);
}

TEST_F(PaperTrackerLife, MergesConfirmedNeighboursUnderTheOlderName) {
  PaperTrackerConfig narrow;
  narrow.measurement_sigma_m = 0.1;
  tracker_.emplace(narrow, 64);
  for (int i = 0; i < 6; ++i) see({{0, 0}, {1.5, 0}});
  ASSERT_EQ(tracks().size(), 2U);  // too far apart to merge
  const auto older = tracks()[0].id;
  for (int i = 0; i < 200 && tracks().size() == 2; ++i) see({{0, 0}, {1.5 - 0.02 * i, 0}});
  ASSERT_EQ(tracks().size(), 1U);
  EXPECT_EQ(tracks()[0].id, older);
  EXPECT_EQ(tracker_->counters().merged, 1U);
  EXPECT_GE(tracks()[0].hits, 12);
}

TEST_F(PaperTrackerLife, NeverReusesAnId) {
  see({{0, 0}});
  const auto first = tracks()[0].id;
  for (int i = 0; i < 2 * config_.max_penalty; ++i) see({});
  ASSERT_TRUE(tracks().empty());
  see({{0, 0}});
  EXPECT_GT(tracks()[0].id, first);
}

TEST_F(PaperTrackerLife, KeepsTheMajorityClass) {
  for (int i = 0; i < 9; ++i) see({{0, 0}}, i % 3 == 0 ? 7 : 2);
  EXPECT_EQ(tracks()[0].class_id(), 2);
  EXPECT_NEAR(tracks()[0].confidence(), 0.9, 1e-12);
}

TEST_F(PaperTrackerLife, RefusesObjectsBeyondItsRoomAndCountsThem) {
  PaperTrackerConfig small;
  small.max_tracks = 3;
  tracker_.emplace(small, 64);
  see({{-12, 0}, {-6, 0}, {0, 0}, {6, 0}, {12, 0}});
  EXPECT_EQ(tracks().size(), 3U);
  EXPECT_EQ(tracker_->counters().refused, 2U);
}

/// One axis of the textbook's filter: a constant measured with R, and Q added after each measurement.
TEST_F(PaperTrackerLife, EstimatesByTheTextbooksKalmanFilter) {
  PaperTrackerConfig config;
  config.process_sigma_m = 0.2;
  tracker_.emplace(config, 64);
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 0.5);
  const double r = config.measurement_sigma_m * config.measurement_sigma_m, q = 0.2 * 0.2;
  double mean = 0.0, variance = 0.0;
  for (int i = 0; i < 12; ++i) {
    const double measured = 3.0 + noise(random);
    see({{measured, -2.0}});
    const double gain = i == 0 ? 1.0 : variance / (variance + r);
    mean += gain * (measured - mean);
    variance = i == 0 ? r : (1.0 - gain) * variance + q;
    ASSERT_EQ(tracks().size(), 1U);
    EXPECT_NEAR(tracks()[0].position_in_enu.mean.x(), mean, 1e-12);
    EXPECT_NEAR(tracks()[0].position_in_enu.covariance(0, 0), variance, 1e-12);
    EXPECT_NEAR(tracks()[0].position_in_enu.covariance(0, 1), 0.0, 1e-12);
  }
}

TEST_F(PaperTrackerLife, MatchesWithinTheGate) {
  const double sigma_m = std::sqrt(2.0) * config_.measurement_sigma_m;  // of two measurements' difference
  for (const double share : {0.98, 1.02}) {
    tracker_.emplace(config_, 64);
    see({{0, 0}});
    see({{0, share * config_.gate * sigma_m}});
    EXPECT_EQ(tracks().size(), share < 1.0 ? 1U : 2U);
  }
}

/// What the detection's sigma makes on the ground is added to R, at the gate and in the estimate.
TEST_F(PaperTrackerLife, TrustsADetectionLessThatTrustsItselfLess) {
  LocatedDetection located{};
  located.detection.confidence = 0.9;
  located.detection.sigma_px = 100.0;
  located.fix.ground_from_pixel = 0.03 * Eigen::Matrix2d::Identity();  // 3 m
  const double r = config_.measurement_sigma_m * config_.measurement_sigma_m;
  FrameView view;
  const double gate_m = config_.gate * std::sqrt(2.0 * (r + 9.0));
  for (const double share : {0.98, 1.02}) {
    tracker_.emplace(config_, 64);
    located.fix.position_in_enu = {0.0, 0.0};
    std::vector<LocatedDetection> detections{located};
    tracker_->update({detections, projector_, view, local_frame_, {}, viewer_, ground_, std::nullopt});
    EXPECT_NEAR(tracks()[0].position_in_enu.covariance(0, 0), r + 9.0, 1e-12);
    detections[0].fix.position_in_enu.x() = share * gate_m;
    tracker_->update({detections, projector_, view, local_frame_, {}, viewer_, ground_, std::nullopt});
    ASSERT_EQ(tracks().size(), share < 1.0 ? 1U : 2U);
    if (share > 1.0) continue;
    EXPECT_NEAR(tracks()[0].position_in_enu.mean.x(), 0.5 * share * gate_m, 1e-9);
    const double q = config_.process_sigma_m * config_.process_sigma_m;
    EXPECT_NEAR(tracks()[0].position_in_enu.covariance(0, 0), 0.5 * (r + 9.0) + q, 1e-9);
  }
}

TEST_F(PaperTrackerLife, MatchesEachDetectionToItsOwnTrackWhereFarTracksLieBetween) {
  see({{0, 0}, {-12, 0}, {10, 0}, {12, 6}});
  see({{10.3, 0}, {0.3, 0}});
  ASSERT_EQ(tracks().size(), 4U);
  EXPECT_EQ(tracks()[0].hits, 2);
  EXPECT_EQ(tracks()[1].hits, 1);
  EXPECT_EQ(tracks()[2].hits, 2);
  EXPECT_EQ(tracks()[3].hits, 1);
  EXPECT_NEAR(tracks()[2].position_in_enu.mean.x(), 10.15, 1e-9);
}

TEST_F(PaperTrackerLife, CountsWhatBecomesOfTracks) {
  see({{0, 0}, {5, 0}});
  for (int i = 0; i < config_.max_penalty; ++i) see({{0, 0}});
  EXPECT_EQ(tracker_->counters().created, 2U);
  EXPECT_EQ(tracker_->counters().removed, 1U);
  EXPECT_EQ(tracks()[0].penalty, 0);
}

/// Two estimates of one object are combined by their information.
TEST_F(PaperTrackerLife, MergesConfirmedNeighboursWithinTheDistance) {
  for (const double share : {0.99, 1.01}) {
    PaperTrackerConfig config;
    config.measurement_sigma_m = 0.02;
    config.process_sigma_m = 0.0;
    config.confirm_hits = 3;
    config.merge_distance_m = 0.5;
    tracker_.emplace(config, 64);
    const double apart_m = share * config.merge_distance_m;
    for (int i = 0; i < 2; ++i) see({{0, 0}, {apart_m, 0}});
    EXPECT_EQ(tracks().size(), 2U);  // not confirmed yet
    see({{0, 0}, {apart_m, 0}});
    if (share > 1.0) {
      EXPECT_EQ(tracks().size(), 2U);
      continue;
    }
    ASSERT_EQ(tracks().size(), 1U);
    EXPECT_NEAR(tracks()[0].position_in_enu.mean.x(), 0.5 * apart_m, 1e-9);
    EXPECT_NEAR(tracks()[0].position_in_enu.covariance(0, 0), 0.0004 / 6.0, 1e-9);
    EXPECT_EQ(tracks()[0].hits, 6);
  }
}

TEST_F(PaperTrackerLife, AnswersWhatItDoesNotLearn) {
  EXPECT_FALSE(tracker_->calibration_of_camera());
  EXPECT_EQ(tracker_->calibration().mean, CalibrationVector(CalibrationVector::Zero()));
  EXPECT_TRUE(tracker_->known_points().empty());
}

TEST(PaperTrackerConfig, NamesEveryProblem) {
  PaperTrackerConfig config;
  config.measurement_sigma_m = 0;
  config.gate = std::numeric_limits<double>::quiet_NaN();
  config.confirm_hits = 0;
  EXPECT_EQ(config.problems().size(), 3U);
  EXPECT_THROW(PaperTracker(config, 10), std::invalid_argument);
}

}  // namespace
}  // namespace geoloc
