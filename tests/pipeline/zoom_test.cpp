// SPDX-License-Identifier: Apache-2.0
// What is promised of a camera whose focal length comes with each frame.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::NadirFlight;

const std::vector<Eigen::Vector2d> kPlaces{{-4, -2}, {3, 1}, {-2, 5}, {5, 9}, {0, 14}, {-5, 20}, {4, 27}};

FrameDetections frame_at(double time_s) {
  FrameDetections frame;
  frame.captured_at = testing::at_s(time_s);
  frame.captured_at_host = testing::host_at_s(time_s);
  return frame;
}

/// A frame of the flight as its camera shows it `zoom` times as large, with noise that grows with the boxes.
FrameDetections zoomed_frame(const NadirFlight& flight, double time_s, double zoom, std::mt19937& random) {
  std::normal_distribution<double> noise_px(0.0, 1.0);
  const Eigen::Vector2d principal_px(testing::kPrincipalX_px, testing::kPrincipalY_px);
  FrameDetections frame = frame_at(time_s);
  for (const Eigen::Vector2d& place : kPlaces) {
    const Eigen::Vector2d noise(noise_px(random), noise_px(random));
    const auto pixel = flight.shown(time_s, place);
    if (!pixel) continue;
    const Eigen::Vector2d zoomed_px = principal_px + zoom * (*pixel + noise - principal_px);
    const bool is_inside = zoomed_px.x() > 40 && zoomed_px.x() < testing::kImageWidth_px - 40 &&
                           zoomed_px.y() > 40 && zoomed_px.y() < testing::kImageHeight_px - 40;
    if (is_inside) frame.detections.push_back(testing::box_at(zoomed_px, 36.0 * zoom));
  }
  return frame;
}

/// `zoom_of`: of the frame with that number. Frames tell their focal lengths, unless the camera's calibration
/// does.
template <typename ZoomOf>
std::vector<Track> fly(GeolocatorConfig config, double calibrated_zoom, const ZoomOf& zoom_of,
                       bool is_told = true) {
  config.camera.intrinsics.fx_px = config.camera.intrinsics.fy_px = calibrated_zoom * testing::kFocal_px;
  NadirFlight flight(config, testing::in_gusts);
  std::mt19937 random(1);
  for (int i = 0; i < 250; ++i) {
    const double time_s = 1.0 + 0.1 * i, zoom = zoom_of(i);
    FrameDetections frame = zoomed_frame(flight, time_s, zoom, random);
    if (is_told) frame.focal_px = Eigen::Vector2d::Constant(zoom * testing::kFocal_px);
    flight.fly_until(time_s);
    EXPECT_TRUE(flight.geolocator().process(frame));
  }
  flight.geolocator().finish();
  return flight.tracks();
}

GeolocatorConfig by(Method method) {
  GeolocatorConfig config;
  config.method = method;
  return config;
}

/// The lens bends rays as it does on the calibration, whatever the zoom.
TEST(Zoom, FramesWithAFocalLengthOfTheirOwnAreLocatedAsByACameraCalibratedSo) {
  for (const Method method : {Method::kPaper, Method::kJoint}) {
    GeolocatorConfig config = by(method);
    config.camera.intrinsics.distortion = {-0.05, 0.01, 0.001, -0.0005, 0.0};
    NadirFlight by_frame(config, testing::in_gusts);
    config.camera.intrinsics.fx_px = 1830.0;
    config.camera.intrinsics.fy_px = 1795.0;
    NadirFlight calibrated(config, testing::in_gusts);
    FrameDetections frame = frame_at(2.05);
    frame.detections = {testing::box_at({640, 360}), testing::box_at({300, 500}), testing::box_at({900, 90})};
    by_frame.fly_until(2.05);
    calibrated.fly_until(2.05);
    ASSERT_TRUE(calibrated.geolocator().process(frame));
    frame.focal_px = Eigen::Vector2d(1830.0, 1795.0);
    ASSERT_TRUE(by_frame.geolocator().process(frame));
    const auto& expected = calibrated.geolocator().located();
    const auto& located = by_frame.geolocator().located();
    ASSERT_EQ(located.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(located[i].fix.position_in_enu, expected[i].fix.position_in_enu);
      EXPECT_EQ(located[i].fix.ground_from_pixel, expected[i].fix.ground_from_pixel);
    }
  }
}

/// From its first frame to its last: nothing that looks back, or ahead, takes the calibration's.
TEST(Zoom, AFlightWhoseFramesTellTheFocalLengthIsThatOfACameraCalibratedSo) {
  for (const Method method : {Method::kPaper, Method::kJoint}) {
    const auto wide = [](int) { return 1.0; };
    const std::vector<Track> expected = fly(by(method), 1.0, wide, false);
    const std::vector<Track> tracks = fly(by(method), 2.5, wide);
    ASSERT_EQ(tracks.size(), expected.size());
    ASSERT_EQ(tracks.size(), kPlaces.size());
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      EXPECT_EQ(tracks[i].position_in_enu.mean, expected[i].position_in_enu.mean);
      EXPECT_EQ(tracks[i].position_in_enu.covariance, expected[i].position_in_enu.covariance);
      EXPECT_EQ(tracks[i].existence, expected[i].existence);
    }
  }
}

TEST(Zoom, AFlightThatZoomsInAndOutFindsEachObjectOnceAndWhereItIs) {
  const auto alternating = [](int frame) { return frame % 2 == 0 ? 1.0 : 1.6; };
  const auto in_and_out = [](int frame) { return 1.6 + 0.6 * std::sin(0.05 * frame); };
  for (const Method method : {Method::kPaper, Method::kJoint}) {
    for (const std::vector<Track>& tracks :
         {fly(by(method), 1.0, alternating), fly(by(method), 1.0, in_and_out)}) {
      std::size_t confirmed = 0;
      for (const Track& track : tracks) {
        if (track.status != TrackStatus::kConfirmed) continue;
        ++confirmed;
        double nearest_m = std::numeric_limits<double>::infinity();
        for (const Eigen::Vector2d& place : kPlaces)
          nearest_m = std::min(nearest_m, (track.position_in_enu.mean - place).norm());
        EXPECT_LT(nearest_m, 0.08) << static_cast<int>(method);
      }
      EXPECT_EQ(confirmed, kPlaces.size()) << static_cast<int>(method);
    }
  }
}

TEST(Zoom, AFocalLengthThatCannotBeIsCountedAndChangesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  NadirFlight flight({}, testing::in_gusts);
  flight.fly_until(1.0);
  for (const double fx_px : {nan, 0.0, -914.0, 1e-3, 1e300, std::numeric_limits<double>::infinity()}) {
    for (const Eigen::Vector2d& focal_px : {Eigen::Vector2d(fx_px, 914.0), Eigen::Vector2d(914.0, fx_px)}) {
      FrameDetections frame = frame_at(1.0);
      frame.detections = {testing::box_at({640, 360})};
      frame.focal_px = focal_px;
      EXPECT_FALSE(flight.geolocator().process(frame));
    }
  }
  const auto& counters = flight.geolocator().counters();
  EXPECT_EQ(counters.frames_by_fate[static_cast<std::size_t>(FrameFate::kUnusableFocalLength)], 12U);
  EXPECT_TRUE(flight.tracks().empty());
}

}  // namespace
}  // namespace geoloc
