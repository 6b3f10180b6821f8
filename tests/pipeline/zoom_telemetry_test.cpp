// SPDX-License-Identifier: Apache-2.0
// What is promised of a camera that tells its field of view by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"
#include "geoloc/state/state_provider.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc {
namespace {

using testing::NadirFlight;

/// The horizontal angle of a camera that is zoomed in so far.
FieldOfViewSample field_of_view(double time_s, double zoom) {
  const double angle_rad = 2.0 * std::atan(0.5 * testing::kImageWidth_px / (zoom * testing::kFocal_px));
  return {testing::at_s(time_s), angle_rad, std::nullopt};
}

FrameDetections frame_at(double time_s) {
  FrameDetections frame;
  frame.captured_at = testing::at_s(time_s);
  frame.captured_at_host = testing::host_at_s(time_s);
  frame.detections = {testing::box_at({640, 360}), testing::box_at({300, 500})};
  return frame;
}

class ZoomTelemetry : public ::testing::Test {
 protected:
  ZoomTelemetry() { flight_.fly_until(4.0); }

  void tell(double time_s, double zoom) { geolocator_.add(field_of_view(time_s, zoom)); }

  /// nullopt: it was not located.
  std::optional<Eigen::Vector2d> focal_px_at(double time_s) {
    if (!geolocator_.process(frame_at(time_s))) return std::nullopt;
    return geolocator_.view().focal_px;
  }

  NadirFlight flight_{GeolocatorConfig{}, testing::in_gusts};
  Geolocator& geolocator_ = flight_.geolocator();
};

TEST_F(ZoomTelemetry, LocatesEachFrameWithTheFocalLengthOfItsTime) {
  tell(1.0, 2.0);
  tell(1.2, 3.0);
  const auto focal_px = focal_px_at(1.1);
  ASSERT_TRUE(focal_px);
  EXPECT_TRUE(focal_px->isApprox(Eigen::Vector2d::Constant(2.5 * testing::kFocal_px), 1e-9));
  EXPECT_GT(geolocator_.view().sigma_focal_share, 0.0);
}

/// To the bit: cameras that tell what is known already change nothing.
TEST_F(ZoomTelemetry, ChangesNothingWhereTheCameraStandsStillNearItsCalibration) {
  NadirFlight silent{GeolocatorConfig{}, testing::in_gusts};
  silent.fly_until(4.0);
  for (int i = 0; i < 20; ++i) tell(1.0 + 0.2 * i, 1.03);
  for (double time_s = 1.1; time_s < 4.9; time_s += 0.1) {
    ASSERT_TRUE(geolocator_.process(frame_at(time_s)));
    ASSERT_TRUE(silent.geolocator().process(frame_at(time_s)));
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_EQ(geolocator_.located()[i].fix.position_in_enu,
                silent.geolocator().located()[i].fix.position_in_enu);
  }
}

TEST_F(ZoomTelemetry, TakesWhatItIsOffByAtTheCalibrationOutOfAllElse) {
  for (int i = 0; i < 5; ++i) tell(1.0 + 0.2 * i, 1.03);
  for (int i = 0; i < 5; ++i) tell(3.0 + 0.2 * i, 2.0 * 1.03);
  const auto focal_px = focal_px_at(3.5);
  ASSERT_TRUE(focal_px);
  EXPECT_NEAR(focal_px->x(), 2.0 * testing::kFocal_px, 0.01);
}

TEST_F(ZoomTelemetry, GivesWayToTheFocalLengthThatAFrameTells) {
  tell(1.0, 2.0);
  tell(1.2, 2.0);
  FrameDetections frame = frame_at(1.1);
  frame.focal_px = Eigen::Vector2d(1200.0, 1100.0);
  ASSERT_TRUE(geolocator_.process(frame));
  EXPECT_EQ(geolocator_.view().focal_px, Eigen::Vector2d(1200.0, 1100.0));
}

TEST_F(ZoomTelemetry, DoesNotLocateWhereTheZoomChangedUnseen) {
  tell(1.0, 1.0);
  tell(6.0, 2.0);
  EXPECT_FALSE(focal_px_at(3.0));
  const auto& fates = geolocator_.counters().frames_by_fate;
  EXPECT_EQ(fates[static_cast<std::size_t>(FrameFate::kInAGap)], 1U);
}

TEST_F(ZoomTelemetry, IsWaitedForWhileItComesAndNoLonger) {
  for (const double time_s : {4.4, 4.6, 4.8}) tell(time_s, 2.0);
  geolocator_.add(frame_at(4.85));
  EXPECT_FALSE(geolocator_.process_next()) << "the next one is due at 5.0 s";
  tell(5.0, 2.0);
  const auto outcome = geolocator_.process_next();
  ASSERT_TRUE(outcome);
  EXPECT_TRUE(outcome->is_located());
  geolocator_.add(frame_at(5.05));
  EXPECT_FALSE(geolocator_.process_next());
  flight_.fly_until(7.0);  // and none has come
  ASSERT_TRUE(geolocator_.process_next());
  EXPECT_NEAR(geolocator_.view().focal_px->x(), 2.0 * testing::kFocal_px, 0.01);
}

TEST_F(ZoomTelemetry, RefusesAnglesThatNoLensHasAndTimesThatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double angle_rad : {nan, 0.0, -1.0, 3.2, 1e-9, 1e300}) {
    geolocator_.add(FieldOfViewSample{testing::at_s(1.0), angle_rad, std::nullopt});
    geolocator_.add(FieldOfViewSample{testing::at_s(1.0), std::nullopt, angle_rad});
  }
  geolocator_.add(FieldOfViewSample{testing::at_s(1.0), std::nullopt, std::nullopt});
  tell(4000.0, 2.0);
  EXPECT_EQ(geolocator_.state().counters().focal_lengths, 0U);
  EXPECT_EQ(geolocator_.state().counters().suspect_stamps, 1U);
}

}  // namespace
}  // namespace geoloc
