// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "geoloc/io/output/output_frame.hpp"
#include "support/nadir_flight.hpp"

namespace geoloc::io {
namespace {

const std::vector<std::string> kNames{"car", "person"};

void expect_same(const ObjectReport& a, const ObjectReport& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.class_name, b.class_name);
  EXPECT_EQ(a.class_id, b.class_id);
  EXPECT_EQ(a.confidence, b.confidence);
  EXPECT_EQ(a.hits, b.hits);
  EXPECT_EQ(a.first_seen, b.first_seen);
  EXPECT_EQ(a.last_seen, b.last_seen);
  EXPECT_EQ(a.position.latitude_deg, b.position.latitude_deg);
  EXPECT_EQ(a.position.longitude_deg, b.position.longitude_deg);
  EXPECT_EQ(a.position_in_enu, b.position_in_enu);
  EXPECT_EQ(a.covariance_in_enu, b.covariance_in_enu);
  EXPECT_EQ(a.ellipse.sigma_major_m, b.ellipse.sigma_major_m);
  EXPECT_EQ(a.ellipse.azimuth_deg, b.ellipse.azimuth_deg);
  EXPECT_EQ(a.height.above_home_m, b.height.above_home_m);
  EXPECT_EQ(a.height.sigma_m, b.height.sigma_m);
  EXPECT_EQ(a.height.msl_m, b.height.msl_m);
  EXPECT_EQ(a.course.has_value(), b.course.has_value());
}

class Reporters : public ::testing::TestWithParam<Method> {};

/// Objects are born, confirmed, seen again with another class, and removed; what is kept is what would be
/// made anew.
TEST_P(Reporters, TellWhatIsMadeAnewForEachFrame) {
  GeolocatorConfig config;
  config.method = GetParam();
  testing::NadirFlight flight(config, testing::northwards(2.0));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> across_m(-12.0, 12.0), along_m(0.0, 60.0), chance(0.0, 1.0);
  std::vector<Eigen::Vector2d> places(25);
  for (Eigen::Vector2d& place : places) place = {across_m(random), along_m(random)};
  FrameReporter reporter(kNames);
  std::size_t most = 0;
  for (double time_s = 1.0; time_s < 30.0; time_s += 0.1) {
    std::vector<Detection> detections;
    for (const Eigen::Vector2d& place : places) {
      const auto pixel = flight.shown(time_s, place);
      if (pixel && chance(random) < 0.9)
        detections.push_back(testing::box_at(*pixel, 36.0, chance(random) < 0.6 ? 0 : 1));
    }
    if (chance(random) < 0.3)
      detections.push_back(testing::box_at({1200.0 * chance(random) + 30, 600.0 * chance(random) + 30}));
    const bool is_located = flight.process(time_s, detections);
    const OutputFrame frame =
        reporter.report(flight.geolocator(), is_located, testing::host_at_s(time_s), detections);
    for (const TrackStatus status : {TrackStatus::kConfirmed, TrackStatus::kTentative}) {
      const auto& told = status == TrackStatus::kConfirmed ? frame.objects : frame.tentative;
      const auto anew = report_objects(flight.geolocator(), kNames, status);
      ASSERT_EQ(told.size(), anew.size());
      for (std::size_t i = 0; i < told.size(); ++i) expect_same(told[i], anew[i]);
    }
    most = std::max(most, frame.objects.size());
  }
  EXPECT_GT(most, 10U);
}

INSTANTIATE_TEST_SUITE_P(OfEachMethod, Reporters, ::testing::Values(Method::kJoint, Method::kPaper));

/// Another flight in another place may have an object of the same number at the same place of its own frame.
TEST(FrameReporter, KeepsNothingOfAnotherFlight) {
  FrameReporter reporter(kNames);
  for (const double from_m : {0.0, 50.0}) {
    const auto path = [&](double time_s) {
      testing::Pose pose = testing::northwards(2.0)(time_s);
      pose.position.x() += from_m;
      return pose;
    };
    testing::NadirFlight flight(GeolocatorConfig{}, path);
    for (double time_s = 1.0; time_s < 4.0; time_s += 0.1) {
      const bool is_located = flight.see(time_s, {{from_m + 2.0, 5.0}, {from_m - 3.0, 8.0}});
      const OutputFrame frame =
          reporter.report(flight.geolocator(), is_located, testing::host_at_s(time_s), {});
      const auto anew = report_objects(flight.geolocator(), kNames);
      ASSERT_EQ(frame.objects.size(), anew.size());
      for (std::size_t i = 0; i < anew.size(); ++i) expect_same(frame.objects[i], anew[i]);
    }
  }
}

}  // namespace
}  // namespace geoloc::io
