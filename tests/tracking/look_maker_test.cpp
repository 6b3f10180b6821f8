// SPDX-License-Identifier: Apache-2.0
#include "tracking/look_maker.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "calibration/linearize.hpp"
#include "calibration/noise_estimate.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geoloc/projection/projector.hpp"

namespace geoloc {
namespace {

constexpr double kUp_m = 20.0, kFocal_px = 1000.0;
constexpr double kPixel_m = kUp_m / kFocal_px;
constexpr int kCarClass = 7;
constexpr double kClutterPerFrame = 0.7;
constexpr double kSigmaAttitude_deg = 0.3;  // as far as is known

/// A level vehicle over the origin that flies north-east, its camera looking straight down, the image's top
/// to the north: right is east, down is south, and everything about a look can be written down.
class LooksFromAbove : public ::testing::Test {
 protected:
  LooksFromAbove() {
    config_.moving.classes = {kCarClass};
    config_.sigma_px = 2.0;
    config_.sigma_attitude_deg = 7.0;  // before any was learnt: no look minds
    config_.sigma_time_s = 0.05;
    config_.fast_share = 0.25;
    const Eigen::Matrix3d looking_down = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
    view_.enu_from_camera = {Eigen::Quaterniond(looking_down), {0.0, 0.0, kUp_m}};
    view_.vehicle.velocity_in_enu = {3.0, 4.0, 0.0};
    span_ = errors_.drift.cover(VehicleTime{from_seconds(10.0)}, 0.5);
  }

  static CameraIntrinsics intrinsics() {
    CameraIntrinsics camera;
    camera.fx_px = camera.fy_px = kFocal_px;
    return camera;
  }

  /// A detection of a place [m].
  LocatedDetection located(double east, double north, int class_id = 0, double size_px = 40.0) {
    const CameraIntrinsics camera = intrinsics();
    const Eigen::Vector2d pixel(camera.cx_px + east / kPixel_m, camera.cy_px - north / kPixel_m);
    LocatedDetection located;
    located.detection.box = {pixel.x() + 0.5 - 0.5 * size_px, pixel.y() + 0.5 - 0.75 * size_px, size_px,
                             1.5 * size_px};
    located.detection.class_id = class_id;
    located.fix = *projector_.project(pixel, view_.enu_from_camera);
    return located;
  }

  FrameLooks make(const std::vector<LocatedDetection>& detections) {
    LookMaker maker(config_, 20);
    return maker.make(detections, frame(), errors_);
  }

  JointFrame frame() const {
    return {projector_,       view_,       span_,
            drift_,           repetition_, projector_.config().ground_height_above_home_m + view_.lifted_m,
            kClutterPerFrame, run_time_};
  }

  /// Variances per axis of the noise [m^2].
  double pixel() const { return std::pow(config_.sigma_px * kPixel_m, 2); }
  double attitude() const { return std::pow(kSigmaAttitude_deg * kPi / 180.0 * kUp_m, 2); }
  double position() const { return std::pow(config_.fast_share * accuracy_.radial_m, 2) / 2.0; }

  JointTrackerConfig config_;
  Projector projector_{{}, intrinsics()};
  FrameView view_;
  PositionAccuracy accuracy_{0.8, 0.2, 0.02, 0.02};
  ArrowheadSolver solver_{CalibrationPrior{}, DriftConfig{}};
  HeightPrior height_prior_{0.0, 2.0};
  SharedErrorEstimate errors_{accuracy_, height_prior_, NoiseEstimate(kSigmaAttitude_deg* kRadPerDeg),
                              DriftConfig{}, solver_};
  NodeSpan span_{};
  NodeVector drift_ = NodeVector::Zero();
  NoiseRepetition repetition_{5.0, 3.0};
  RunTimeError run_time_;
};

TEST_F(LooksFromAbove, KnowTheirNoise) {
  const FrameLooks looks = make({located(0.0, 0.0)});
  ASSERT_EQ(looks.at_rest.size(), 1U);
  const Look& look = looks.at_rest[0];
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  EXPECT_LT((look.pixel_noise - pixel() * one).norm(), 1e-12);
  EXPECT_LT((look.frame_noise - (attitude() + position()) * one).norm(), 1e-12);
  const Eigen::Vector2d velocity(3.0, 4.0);
  const Eigen::Matrix2d time = 0.05 * 0.05 * velocity * velocity.transpose();
  const Eigen::Matrix2d noise = (pixel() + 3.0 * attitude() + 5.0 * position()) * one + time;
  EXPECT_LT((look.observation.information.inverse() - noise).norm(), 1e-9);
}

/// Noise that a flight's frames have shown: what looks have in common for the most part, and the rest.
TEST_F(LooksFromAbove, HaveTheNoiseThatWasLearnt) {
  for (int frame = 0; frame < 200; ++frame) {
    const double sign = frame % 2 == 0 ? 1.0 : -1.0;
    errors_.noise.begin_frame();
    for (const double east : {-5.0, 1.0, 6.0}) {
      Eigen::Matrix<double, 2, 3> turn;
      turn << 0.0, kUp_m, 0.0, -kUp_m, 0.0, -east;
      errors_.noise.add({{sign * 0.9, east > 0.0 ? 0.1 : -0.1},
                         turn,
                         0.01 * Eigen::Matrix2d::Identity(),
                         Eigen::Matrix2d::Zero()});
    }
    errors_.noise.learn_from_frame(position());
  }
  const NoiseEstimate& learnt = errors_.noise;
  for (const double factor : {learnt.pixel_factor(), learnt.position_factor()})
    EXPECT_GT(std::abs(factor - 1.0), 0.1);
  EXPECT_GT(std::abs(std::sqrt(learnt.attitude_variance_rad2()) * kDegPerRad - kSigmaAttitude_deg), 0.1);
  const Look look = make({located(0.0, 0.0)}).at_rest[0];
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  EXPECT_LT((look.pixel_noise - learnt.pixel_factor() * pixel() * one).norm(), 1e-12);
  const double frame_variance =
      learnt.attitude_variance_rad2() * kUp_m * kUp_m + learnt.position_factor() * position();
  EXPECT_LT((look.frame_noise - frame_variance * one).norm(), 1e-12);
}

/// Frames between the same two samples of slow telemetry, and the looks of each, share what interpolation is
/// off by.
TEST_F(LooksFromAbove, KnowHowFarTheStateWasInterpolated) {
  repetition_.of_interpolation = 7.0;
  const std::vector<LocatedDetection> detections{located(0.0, 0.0), located(0.0, 5.0)};
  const Look known = make(detections).at_rest[0];
  view_.turn.sigma_rad = 0.02;
  view_.vehicle.sigma_position_m = 0.3;
  const Look interpolated = make(detections).at_rest[0];
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d added = (std::pow(0.02 * kUp_m, 2) + 0.3 * 0.3) * one;
  EXPECT_LT((interpolated.frame_noise - known.frame_noise - added).norm(), 1e-9);
  EXPECT_LT((interpolated.observation.information.inverse() - known.observation.information.inverse() -
             2.0 * 7.0 * added)
                .norm(),
            1e-9);
}

/// A bend turns the looks about the vehicle: each may be shifted another way.
TEST_F(LooksFromAbove, HaveWhatABendMayAddEachForItself) {
  repetition_.of_interpolation = 7.0;
  const std::vector<LocatedDetection> detections{located(0.0, 0.0), located(0.0, 5.0)};
  const Look straight = make(detections).at_rest[0];
  view_.turn.sigma_bend_rad = 0.1;
  const Look bent = make(detections).at_rest[0];
  const Eigen::Matrix2d added = std::pow(0.1 * kUp_m, 2) * Eigen::Matrix2d::Identity();
  EXPECT_LT((bent.pixel_noise - straight.pixel_noise - added).norm(), 1e-9);
  EXPECT_LT((bent.frame_noise - straight.frame_noise).norm(), 1e-12);
  EXPECT_LT((bent.observation.information.inverse() - straight.observation.information.inverse() -
             (1.0 + 2.0 * 7.0) * added)
                .norm(),
            1e-7);
}

/// By similar triangles: whatever the look itself shows, and however much higher the camera is than reported.
TEST_F(LooksFromAbove, AreComparedWithPointsWhereTheRayThroughThesePassesToTheGround) {
  for (const double higher_m : {0.0, 2.0, -3.0}) {
    errors_.calibration.mean[CalibrationIndex::kHeight] = higher_m;
    const double up_m = kUp_m + higher_m;
    for (const Look& look : make({located(0.0, 0.0), located(6.0, -5.0), located(-4.0, 3.0)}).at_rest) {
      EXPECT_NEAR(look.camera_height_m, up_m, 1e-12);
      for (const Eigen::Vector3d& point :
           {Eigen::Vector3d(0, 0, 3), Eigen::Vector3d(5, -3, 0), Eigen::Vector3d(5, -3, 4),
            Eigen::Vector3d(-7, 2, -6), Eigen::Vector3d(2, 1, 0.8 * up_m)}) {
        const Eigen::Vector2d on_ground = point.head<2>() * up_m / (up_m - point.z());
        EXPECT_LT((look.shown(point) - on_ground).norm(), 1e-9) << point.transpose();
        EXPECT_LT((look.slope_at(on_ground) + on_ground / up_m).norm(), 1e-9) << point.transpose();
      }
      for (const double above : {1.0, 1.5}) EXPECT_TRUE(look.shown({2.0, 1.0, above * up_m}).allFinite());
    }
  }
}

TEST_F(LooksFromAbove, TrustADetectionAsItTrustsItself) {
  LocatedDetection detection = located(0.0, 0.0);
  detection.detection.sigma_px = 5.0;
  EXPECT_NEAR(make({detection}).at_rest[0].pixel_noise(0, 0), std::pow(5.0 * kPixel_m, 2), 1e-12);
}

TEST_F(LooksFromAbove, ShareTheAttitudeWithAllThatStandsStill) {
  const FrameLooks looks = make({located(0, 0), located(0, 5), located(5, 0), located(-5, 0, kCarClass)});
  ASSERT_EQ(looks.at_rest.size(), 3U);
  ASSERT_EQ(looks.moving.size(), 1U);
  const Eigen::Matrix2d noise = looks.at_rest[0].observation.information.inverse();
  const double across = 0.05 * 0.05 * (3.0 * 3.0);
  EXPECT_NEAR(noise(0, 0), pixel() + 3.0 * 3.0 * attitude() + 5.0 * position() + 3.0 * across, 1e-9);
}

/// A late frame shows all of its objects late: many of them are no better witnesses of the vehicle's speed.
TEST_F(LooksFromAbove, ShareTheStampWithAllThatStandsStill) {
  const Eigen::Vector2d velocity(3.0, 4.0);
  const Eigen::Matrix2d per_s2 = velocity * velocity.transpose();
  for (const int others : {0, 1, 6}) {
    std::vector<LocatedDetection> detections{located(0.0, 0.0), located(-5.0, 0.0, kCarClass)};
    for (int i = 0; i < others; ++i) detections.push_back(located(4.0, 1.0 * i));
    const auto noise = [&](const RunTimeError& run_time) {
      run_time_ = run_time;
      return Eigen::Matrix2d(make(detections).at_rest[0].observation.information.inverse());
    };
    const double share = 1.0 + others;
    const Eigen::Matrix2d of_the_rest =
        (pixel() + 3.0 * share * attitude() + 5.0 * position()) * Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d of_its_own = share * 0.05 * 0.05 * per_s2;
    EXPECT_LT((noise({}) - of_the_rest - of_its_own).norm(), 1e-8) << others;
    // What the stamps of a run of frames have in common is shared by the looks of all of them.
    const Eigen::Matrix2d of_the_run = 30.0 * share * 0.2 * 0.2 * per_s2;
    EXPECT_LT((noise({0.2, 30.0}) - of_the_rest - of_its_own - of_the_run).norm(), 1e-6) << others;
  }
}

/// Once the flight has begun the spells of the sway follow what lasts: what is left in the looks is what it
/// does within a spell. What no spell follows stays.
TEST_F(LooksFromAbove, LeaveToTheSwayMostOfWhatLasts) {
  repetition_.of_interpolation = 7.0;
  view_.turn.sigma_rad = 0.02;
  view_.vehicle.sigma_position_m = 0.3;
  const std::vector<LocatedDetection> detections{located(0.0, 0.0), located(0.0, 5.0)};
  const Look at_first = make(detections).at_rest[0];
  errors_.is_opening = false;
  const Look later = make(detections).at_rest[0];
  const Eigen::Matrix2d lasting = (2.0 * 3.0 * attitude() + 5.0 * position()) * Eigen::Matrix2d::Identity();
  EXPECT_LT(
      (at_first.observation.information.inverse() - later.observation.information.inverse() - 0.75 * lasting)
          .norm(),
      1e-8);
  // What does not last from one frame to the next is no sway.
  repetition_.of_attitude = 1.0;
  const Eigen::Matrix2d still = (2.0 * attitude() + 5.0 * position()) * Eigen::Matrix2d::Identity() - lasting;
  const Look of_still = make(detections).at_rest[0];
  EXPECT_LT((of_still.observation.information.inverse() - at_first.observation.information.inverse() - still)
                .norm(),
            1e-8);
  // Association compares frames: what they are off by is the same as ever.
  EXPECT_EQ(later.frame_noise, at_first.frame_noise);
  EXPECT_EQ(later.pixel_noise, at_first.pixel_noise);
}

/// Each look has its own Jacobians; what the frame's noise does to it is the mean over the looks at rest.
TEST_F(LooksFromAbove, HaveTheMeanOfTheirFramesNoiseInCommon) {
  for (const bool any_at_rest : {true, false}) {
    const int class_id = any_at_rest ? 0 : kCarClass;
    const FrameLooks looks =
        make({located(0, 0, class_id), located(6, 5, class_id), located(-6, 1, kCarClass)});
    const std::vector<Look>& counted = any_at_rest ? looks.at_rest : looks.moving;
    Eigen::Matrix2d mean = Eigen::Matrix2d::Zero();
    for (const Look& look : counted) mean += look.frame_noise / static_cast<double>(counted.size());
    EXPECT_LT((looks.frame_noise - mean).norm(), 1e-12);
    EXPECT_GT((counted[0].frame_noise - counted[1].frame_noise).norm(), 1e-7);
    for (const std::vector<Look>* kind : {&looks.at_rest, &looks.moving}) {
      for (const Look& look : *kind) {
        const Eigen::Matrix2d columns = look.jacobian.middleCols<2>(SharedError::kFrame);
        EXPECT_LT((columns * columns.transpose() - mean).norm(), 1e-12);
      }
    }
  }
  EXPECT_EQ(make({}).frame_noise, Eigen::Matrix2d(Eigen::Matrix2d::Zero()));
}

TEST_F(LooksFromAbove, MoveWithTheSharedErrors) {
  const FrameLooks looks = make({located(0.0, 0.0)});
  const Look& look = looks.at_rest[0];
  const CalibrationPrior prior;
  constexpr double kDegree = kPi / 180.0;
  // Turning about its right axis the camera looks north, about its down axis east; about its line of sight it
  // sees the same. A late frame shows the vehicle farther back, a late position is farther back itself.
  Eigen::Matrix<double, 2, SharedError::kCalibrationSize> expected;
  expected.setZero();
  expected(1, 0) = kUp_m * prior.sigma_boresight_x_deg * kDegree;
  expected(0, 1) = kUp_m * prior.sigma_boresight_y_deg * kDegree;
  expected.col(3) = -prior.sigma_latency_s * Eigen::Vector2d(3.0, 4.0);
  expected.col(6) = prior.sigma_position_lag_s * Eigen::Vector2d(3.0, 4.0);
  EXPECT_LT((look.jacobian.leftCols<SharedError::kCalibrationSize>() - expected).norm(), 1e-9);
  EXPECT_LT((look.jacobian.col(SharedError::kTime) + 0.05 * Eigen::Vector2d(3.0, 4.0)).norm(), 1e-12);
}

/// From a camera that is higher, what is aside is farther aside; and what is higher is nearer.
TEST_F(LooksFromAbove, MoveWithTheHeightTheMoreTheFartherAsideTheyAre) {
  const Look look = make({located(6.0, 5.0)}).at_rest[0];
  const Eigen::Vector2d per_metre(6.0 / kUp_m, 5.0 / kUp_m);
  const double sigma_m = height_prior_.sigma_at(0.0);
  EXPECT_LT(
      (look.jacobian.col(SharedError::kCalibration + CalibrationIndex::kHeight) - sigma_m * per_metre).norm(),
      1e-9);
  EXPECT_LT((look.observation.slope + per_metre).norm(), 1e-9);
  EXPECT_LT((look.observation.node_jacobian.col(2) - per_metre).norm(), 1e-9);
}

/// A longer focal length makes less of what is aside.
TEST_F(LooksFromAbove, MoveWithTheFocalLengthTowardsTheMiddleOfTheImage) {
  const Look look = make({located(6.0, 5.0)}).at_rest[0];
  EXPECT_LT((look.observation.calibration_jacobian.col(CalibrationIndex::kFocal) + Eigen::Vector2d(6.0, 5.0))
                .norm(),
            1e-9);
}

/// The ray through a pole 8 m high passes over the ground behind it: by similar triangles.
TEST_F(LooksFromAbove, ShowWhatIsHigherWhereItsRayMeetsTheGround) {
  const Eigen::Vector2d foot(3.0, -4.2);
  const Look look = make({located(foot.x() * 20.0 / 12.0, foot.y() * 20.0 / 12.0)}).at_rest[0];
  EXPECT_LT((look.shown({foot.x(), foot.y(), 8.0}) - look.position).norm(), 1e-9);
  EXPECT_LT((look.observation.point_jacobian() * Point(foot.x(), foot.y(), 8.0) - look.position).norm(),
            1e-9);
}

/// What the fix already holds of the calibration is undone in the sums' values; the offset was never in it.
/// The latency and height that count are those that the view was located with, not the estimate.
TEST_F(LooksFromAbove, AreCorrectedByOffsetAndDrift) {
  errors_.calibration.mean << 0.01, -0.02, 0.03, 0.1, 0.5, 0.0, 0.02, 0.7, -0.4;
  view_.latency_s = 0.08;
  view_.lifted_m = 0.3;
  drift_.setZero();
  drift_.head<4>() << 0.2, 0.3, 0.4, 0.05;
  const LocatedDetection detection = located(6.0, 5.0);
  const Look look = make({detection}).at_rest[0];
  const Eigen::Vector2d by_height = (0.5 - 0.3 + 0.4) / kUp_m * Eigen::Vector2d(6.0, 5.0);
  const Eigen::Vector2d by_latency = -(0.1 - 0.08) * Eigen::Vector2d(3.0, 4.0);
  // Yaw that is more clockwise than reported turns what is seen clockwise about the vehicle.
  const Eigen::Vector2d turned = 0.05 * Eigen::Vector2d(5.0, -6.0);
  EXPECT_LT((look.position -
             (Eigen::Vector2d(6.7, 4.6) + Eigen::Vector2d(0.2, 0.3) + turned + by_height + by_latency))
                .norm(),
            1e-9);
  const FixJacobians jacobians = jacobians_of(detection.fix, view_, kUp_m);
  Eigen::Matrix<double, SharedError::kCalibrationSize, 1> applied;
  applied << 0.01, -0.02, 0.03, 0.08, 0.3, 0.0, 0.02;
  const Eigen::Vector2d value =
      Eigen::Vector2d(6.0, 5.0) - jacobians.calibration.leftCols<SharedError::kCalibrationSize>() * applied;
  EXPECT_LT((look.observation.value - value).norm(), 1e-9);
  EXPECT_EQ(look.observation.calibration_jacobian, jacobians.calibration);
  EXPECT_EQ(look.observation.node_jacobian, jacobians.node);
  EXPECT_EQ(look.observation.span.first, span_.first);
}

TEST_F(LooksFromAbove, StandOnTheGroundThatIsStated) {
  ProjectorConfig raised;
  raised.ground_height_above_home_m = 10.0;
  projector_ = Projector(raised, intrinsics());
  const Look look = make({located(0.0, 0.0)}).at_rest[0];
  EXPECT_NEAR(look.jacobian(1, 0), 0.5 * kUp_m * CalibrationPrior{}.sigma_boresight_x_deg * kPi / 180.0,
              1e-9);
}

TEST_F(LooksFromAbove, KnowTheirSizeAndHowRareClutterIs) {
  const Look look = make({located(3.0, -2.0, 0, 40.0)}).at_rest[0];
  EXPECT_NEAR(look.ground_per_pixel_m, kPixel_m, 1e-12);
  EXPECT_NEAR(look.size_m, 40.0 * kPixel_m, 1e-12);  // the smaller side
  const double image_m2 = 1280.0 * 720.0 * kPixel_m * kPixel_m;
  EXPECT_NEAR(look.one_per_image, 1.0 / image_m2, 1e-12);
  EXPECT_NEAR(look.clutter_density, kClutterPerFrame / image_m2, 1e-12);
}

TEST_F(LooksFromAbove, AreNoDuplicatesOfWhatMayMove) {
  config_.duplicate_share = 0.5;
  EXPECT_EQ(make({located(0, 0), located(0.1, 0)}).at_rest.size(), 1U);
  const FrameLooks looks = make({located(0, 0), located(0.1, 0, kCarClass), located(0.2, 0, kCarClass)});
  EXPECT_EQ(looks.at_rest.size(), 1U);
  EXPECT_EQ(looks.moving.size(), 1U);
}

// --- Looks at objects whose place is known.

/// From a camera that looks aside, of a vehicle that climbs and turns over a plane above home. Everything
/// that is estimated is something already, as it is later in a flight.
class LooksAtKnownObjects : public LooksFromAbove {
 protected:
  /// All that an observation speaks of.
  struct Truth {
    Point place;
    CalibrationVector calibration;
    NodeVector drift;

    static constexpr int kSize = kPointSize + CalibrationIndex::kSize + kNodeSize;
    double& component(int i) {
      if (i < kPointSize) return place[i];
      i -= kPointSize;
      return i < CalibrationIndex::kSize ? calibration[i] : drift[i - CalibrationIndex::kSize];
    }
  };

  LooksAtKnownObjects() {
    ProjectorConfig raised;
    raised.ground_height_above_home_m = kPlane_m;
    projector_ = Projector(raised, intrinsics());
    view_.lifted_m = 0.3;
    view_.latency_s = 0.1;
    view_.enu_from_camera.rotation =
        Eigen::AngleAxisd(0.5, Eigen::Vector3d(0.9, -0.3, 0.2).normalized()) * view_.enu_from_camera.rotation;
    view_.enu_from_camera.translation = {2.0, -1.0, kPlane_m + kUp_m};
    view_.vehicle.velocity_in_enu = {3.0, 4.0, 1.2};
    view_.turn.rate_in_enu = {0.3, -0.1, 0.4};
    errors_.calibration.mean << 0.01, -0.02, 0.03, 0.1, 0.8, 0.05, 0.02, 0.7, -0.4;
    view_.focal_ratio = std::exp(0.05);
    drift_.head<2>() << 0.2, 0.3;
  }

  /// As the estimate has it, about the middle of the image.
  Truth as_estimated(double up_m) const { return {{0.0, 8.0, up_m}, errors_.calibration.mean, drift_}; }

  /// An object at the plane that the frame is located on.
  double plane_above_level_m() const { return errors_.calibration.height_m() - view_.lifted_m; }

  /// Where the image shows the object: the camera where and how it truly was, heights from the level ground.
  Eigen::Vector2d pixel_of(const Truth& truth) const {
    const VehicleState& vehicle = view_.vehicle;
    const double late_s = truth.calibration[CalibrationIndex::kLatency] - view_.latency_s;
    const Eigen::Vector3d turned_in_enu =
        -late_s * view_.turn.rate_in_enu - truth.drift[3] * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d turned_in_camera = truth.calibration.head<3>() - errors_.calibration.mean.head<3>();
    Rigid3d camera = view_.enu_from_camera;
    camera.rotation = turn(turned_in_enu) * camera.rotation * turn(turned_in_camera);
    constexpr int kPositionLag = CalibrationIndex::kPositionLag;
    const double lag_s = truth.calibration[kPositionLag] - errors_.calibration.mean[kPositionLag];
    camera.translation += (lag_s - late_s) * vehicle.velocity_in_enu;
    camera.translation.head<2>() +=
        truth.calibration.segment<2>(CalibrationIndex::kOffset) + truth.drift.head<2>();
    camera.translation.z() +=
        truth.calibration[CalibrationIndex::kHeight] - view_.lifted_m - kPlane_m + truth.drift[kNodeUp];
    FrameView view;
    view.enu_from_camera = camera;
    view.focal_ratio = std::exp(truth.calibration[CalibrationIndex::kFocal]);
    return *projector_.reproject(Eigen::Vector3d(truth.place), view);
  }

  static Eigen::Quaterniond turn(const Eigen::Vector3d& by) {
    if (by.norm() == 0.0) return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::AngleAxisd(by.norm(), by.normalized()));
  }

  Look look_of(const Eigen::Vector2d& pixel) const {
    constexpr double kSize_px = 40.0;
    LocatedDetection located;
    located.detection.box = {pixel.x() + 0.5 - 0.5 * kSize_px, pixel.y() + 0.5 - 0.5 * kSize_px, kSize_px,
                             kSize_px};
    located.fix = *projector_.project(pixel, view_);
    return maker_.make_look(located, kShare, frame(), errors_);
  }

  LandmarkObservation known_at(const Point& place, const Eigen::Vector2d& pixel) const {
    return maker_.linearised_at(place, look_of(pixel), kShare, frame(), errors_);
  }

  /// By how much the truth is at odds with an observation.
  static Eigen::Vector2d residual(const LandmarkObservation& observation, const Truth& truth) {
    return observation.point_jacobian() * truth.place - observation.value -
           observation.calibration_jacobian * truth.calibration - observation.node_jacobian * truth.drift;
  }

  static void expect_same(const LandmarkObservation& a, const LandmarkObservation& b, double within) {
    EXPECT_LE((a.value - b.value).norm(), within);
    EXPECT_LE((a.slope - b.slope).norm(), within);
    EXPECT_LE((a.calibration_jacobian - b.calibration_jacobian).norm(), within);
    EXPECT_LE((a.node_jacobian - b.node_jacobian).norm(), within);
    EXPECT_LE((a.information - b.information).norm(), within * b.information.norm());
    EXPECT_EQ(a.span.first, b.span.first);
    EXPECT_EQ(a.span.weight_of_second, b.span.weight_of_second);
    EXPECT_EQ(a.span.spell, b.span.spell);
  }

  static constexpr double kPlane_m = 10.0;
  static constexpr double kShare = 2.0;  // looks that share the frame's noise
  LookMaker maker_{config_, 20};
};

TEST_F(LooksAtKnownObjects, AreAsTheyAreWhereTheyShowAnObjectOfThePlaneAtItsPlace) {
  const Truth truth = as_estimated(plane_above_level_m());
  const Eigen::Vector2d pixel = pixel_of(truth);
  expect_same(known_at(truth.place, pixel), look_of(pixel).observation, 1e-9);
}

/// The ray is one and the same, wherever the object stands along it.
TEST_F(LooksAtKnownObjects, SayTheSameOfAnObjectThatTheyShowAtItsPlace) {
  for (const double up_m : {-6.0, 0.0, 3.0, 8.0}) {
    const Truth truth = as_estimated(up_m);
    const Eigen::Vector2d pixel = pixel_of(truth);
    const LandmarkObservation known = known_at(truth.place, pixel), own = look_of(pixel).observation;
    EXPECT_LT((known.slope - own.slope).norm(), 1e-9) << up_m;
    EXPECT_LT(residual(known, truth).norm(), 1e-9) << up_m;
    EXPECT_LT(residual(own, truth).norm(), 1e-9) << up_m;
  }
}

/// Whatever is other than estimated, by a little, shows the object elsewhere; what the observation makes of
/// that, linearised at the estimate, agrees with it. The oracle is the projection itself.
TEST_F(LooksAtKnownObjects, AgreeToFirstOrderWithWhateverMovesTheirObjectInTheImage) {
  constexpr double kStep = 1e-4;
  for (const double up_m : {plane_above_level_m(), -6.0, 3.0, 8.0}) {
    const Truth estimated = as_estimated(up_m);
    for (int i = 0; i < Truth::kSize; ++i) {
      const auto miss = [&](double step) {
        Truth truth = estimated;
        truth.component(i) += step;
        return residual(known_at(estimated.place, pixel_of(truth)), truth);
      };
      EXPECT_LT((miss(kStep) - miss(-kStep)).norm() / (2.0 * kStep), 1e-5)
          << "component " << i << ", object at " << up_m << " m";
    }
  }
}

/// A pixel, a turn of the camera and a metre of the vehicle's position move an object that is nearer to the
/// camera than the plane by what they do there.
TEST_F(LooksAtKnownObjects, HaveTheNoiseThatMovesThemWhereTheirObjectStands) {
  constexpr double kStep_px = 1e-3;
  for (const double up_m : {plane_above_level_m(), -6.0, 8.0}) {
    const Truth truth = as_estimated(up_m);
    const Eigen::Vector2d pixel = pixel_of(truth);
    const LandmarkObservation known = known_at(truth.place, pixel);
    Eigen::Matrix2d per_pixel;
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector2d step = kStep_px * Eigen::Vector2d::Unit(i);
      per_pixel.col(i) = (known_at(truth.place, pixel + step).value - known.value) / kStep_px;
    }
    const auto turn = known.calibration_jacobian.leftCols<3>();
    const auto late = known.calibration_jacobian.col(CalibrationIndex::kLatency);
    const double turn_rad = kSigmaAttitude_deg * kPi / 180.0;
    const Eigen::Matrix2d noise = 2.0 * 2.0 * per_pixel * per_pixel.transpose() +
                                  kShare * 3.0 * turn_rad * turn_rad * turn * turn.transpose() +
                                  5.0 * position() * Eigen::Matrix2d::Identity() +
                                  kShare * 0.05 * 0.05 * late * late.transpose();
    EXPECT_LT((known.information.inverse() - noise).norm(), 1e-4 * noise.norm()) << up_m;
  }
}

/// Neither the Jacobians nor the weight: what errs to one side would count for more than what errs to the
/// other.
TEST_F(LooksAtKnownObjects, HaveNoneOfTheDetectionsNoiseInTheirJacobians) {
  for (const double up_m : {0.0, 4.0}) {
    const Truth truth = as_estimated(up_m);
    const Eigen::Vector2d pixel = pixel_of(truth);
    const Eigen::Vector2d noise_px(1.8, -2.4);
    const LandmarkObservation one = known_at(truth.place, pixel),
                              other = known_at(truth.place, pixel + noise_px);
    EXPECT_EQ(one.slope, other.slope);
    EXPECT_EQ(one.calibration_jacobian, other.calibration_jacobian);
    EXPECT_EQ(one.node_jacobian, other.node_jacobian);
    EXPECT_EQ(one.information, other.information);
    EXPECT_GT((one.value - other.value).norm(), 0.02);
    EXPECT_GT((look_of(pixel).observation.slope - look_of(pixel + noise_px).observation.slope).norm(), 1e-3);
  }
}

/// By similar triangles, from where the camera is taken to have been.
TEST_F(LooksAtKnownObjects, AreSeenFromWhereTheCameraIsTakenToHaveBeen) {
  const auto slope_from_here = [&](const Point& place) {
    const Eigen::Vector2d camera =
        view_.enu_from_camera.translation.head<2>() + errors_.calibration.offset_m() + drift_.head<2>();
    const double height_m = kUp_m + errors_.calibration.height_m() - view_.lifted_m - place.z();
    return Eigen::Vector2d((camera - place.head<2>()) / height_m);
  };
  const Truth at_first = as_estimated(3.0);
  const Eigen::Vector2d pixel = pixel_of(at_first);
  const auto expect_seen_from_here = [&] {
    EXPECT_LT((known_at(at_first.place, pixel).slope - slope_from_here(at_first.place)).norm(), 1e-12);
  };
  expect_seen_from_here();
  errors_.calibration.mean.segment<2>(CalibrationIndex::kOffset) << -0.9, 1.6;
  expect_seen_from_here();
  drift_.head<2>() << 1.1, -0.8;
  expect_seen_from_here();
  errors_.calibration.mean[CalibrationIndex::kHeight] = -1.5;
  expect_seen_from_here();
  view_.lifted_m = -0.7;
  expect_seen_from_here();
}

TEST_F(LooksAtKnownObjects, StayAsTheyAreWhereTheirObjectCannotBeInView) {
  const Look look = look_of(pixel_of(as_estimated(0.0)));
  const Eigen::Vector3d camera = view_.enu_from_camera.translation;
  const Eigen::Vector3d ahead = view_.enu_from_camera.rotation * Eigen::Vector3d::UnitZ();
  const double level_m = kUp_m + plane_above_level_m();
  const Point behind(camera.x() - 120.0 * ahead.x(), camera.y() - 120.0 * ahead.y(), 0.0);
  for (const Point& place : {Point(0.0, 8.0, level_m + 1.0), Point(0.0, 8.0, 2.0 * level_m),
                             Point(0.0, 8.0, level_m - 1e-9), behind})
    expect_same(maker_.linearised_at(place, look, kShare, frame(), errors_), look.observation, 0.0);
}

}  // namespace
}  // namespace geoloc
