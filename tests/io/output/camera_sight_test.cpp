// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/camera_sight.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/output/cot_sensor.hpp"

namespace geoloc::io {
namespace {

/// A camera that looks there: its right is level but for the roll.
Eigen::Quaterniond looking(double azimuth_deg, double elevation_deg, double roll_deg) {
  const double azimuth = azimuth_deg * kRadPerDeg, elevation = elevation_deg * kRadPerDeg;
  const Eigen::Vector3d forward(std::cos(elevation) * std::sin(azimuth),
                                std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
  const Eigen::Vector3d level_right(std::cos(azimuth), -std::sin(azimuth), 0.0);
  Eigen::Matrix3d axes;
  axes << level_right, forward.cross(level_right), forward;
  return Eigen::AngleAxisd(roll_deg * kRadPerDeg, forward) * Eigen::Quaterniond(axes);
}

TEST(CameraSight, IsWhereTheCameraLooks) {
  for (const double azimuth_deg : {0.0, 17.0, 90.0, 180.0, 269.0, 359.0}) {
    for (const double elevation_deg : {-90.0, -89.0, -45.0, 0.0, 30.0}) {
      for (const double roll_deg : {-20.0, 0.0, 35.0}) {
        if (elevation_deg == -90.0 && roll_deg != 0.0) continue;  // turns the image's top: another azimuth
        const CameraSight sight = sight_of(looking(azimuth_deg, elevation_deg, roll_deg), 0.0);
        EXPECT_NEAR(std::remainder(sight.azimuth_deg - azimuth_deg, 360.0), 0.0, 1e-6);
        EXPECT_GE(sight.azimuth_deg, 0.0);
        EXPECT_LT(sight.azimuth_deg, 360.0);
        EXPECT_NEAR(sight.elevation_deg, elevation_deg, 1e-5);
        EXPECT_NEAR(sight.roll_deg, roll_deg, 1e-6);
      }
    }
  }
}

TEST(CameraSight, CountsFromTrueNorth) {
  EXPECT_NEAR(sight_of(looking(10.0, -45.0, 0.0), 0.5 * kRadPerDeg).azimuth_deg, 9.5, 1e-9);
}

ViewReport some_view() {
  ViewReport view;
  view.vehicle = {47.4, 8.5};
  view.vehicle_in_enu = {0.0, 0.0, 20.0};
  view.sight = {45.0, -60.0, 1.0, 70.0, 43.0, 23.1};
  view.image_centre = GroundPoint{{47.4001, 8.5001}, {7.5, 11.1}};
  return view;
}

TEST(CotOfACamera, HasTheSensorAndItsPointOfInterest) {
  CotConfig config;
  config.sensor_period_s = 1.0;
  config.uid_prefix = "<drone>";  // refused as a setting
  const CotViewContext context{"<drone>.7", HostTime{}, HostTime{}, 450.0};
  const std::string vehicle = vehicle_to_cot(some_view(), context, config);
  for (const char* part : {"uid=\"&lt;drone&gt;.7.vehicle\" type=\"a-f-A-M-H-Q\"",
                           "stale=\"1970-01-01T00:00:05.000Z\"", "hae=\"470.00\"",
                           "<sensor type=\"r-e\" model=\"geoloc\" azimuth=\"45.00\" elevation=\"-60.00\" "
                           "roll=\"1.00\" fov=\"70.00\" "
                           "vfov=\"43.00\" range=\"23.1\"/>"})
    EXPECT_NE(vehicle.find(part), std::string::npos) << part << "\n" << vehicle;
  const std::string point = point_of_interest_to_cot(some_view(), context, config);
  for (const char* part :
       {"type=\"b-m-p-s-p-i\"", "lat=\"47.40010000\" lon=\"8.50010000\" hae=\"9999999.00\"",
        "<link uid=\"&lt;drone&gt;.7.vehicle\" type=\"a-f-A-M-H-Q\" relation=\"p-p\"/>"})
    EXPECT_NE(point.find(part), std::string::npos) << part << "\n" << point;
}

TEST(CotOfACamera, SaysNothingOfGroundThatIsNotThere) {
  ViewReport view = some_view();
  view.image_centre.reset();
  view.sight.range_m.reset();
  EXPECT_EQ(point_of_interest_to_cot(view, {}, {}), "");
  const std::string vehicle = vehicle_to_cot(view, {}, {});
  EXPECT_EQ(vehicle.find("range"), std::string::npos);
  EXPECT_NE(vehicle.find("hae=\"9999999.00\""), std::string::npos);
}

}  // namespace
}  // namespace geoloc::io
