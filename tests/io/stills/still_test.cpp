// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/stills/still.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "geoloc/geometry/angles.hpp"

namespace geoloc::io {
namespace {

using Tags = std::map<std::string, std::string>;

const Tags kSomewhere{{"GPSLatitude", "(46) (50) (34.31)"},
                      {"GPSLatitudeRef", "N"},
                      {"GPSLongitude", "(91) (59) (37.308)"},
                      {"GPSLongitudeRef", "W"}};

Tags joined(Tags tags, const Tags& more) {
  for (const auto& [name, value] : more) tags[name] = value;
  return tags;
}

Still still(const Tags& exif, const Tags& xmp = {}) {
  return still_of({4000, 3000, joined(kSomewhere, exif), xmp});
}

std::string fault_of(const Tags& exif, const Tags& xmp = {}) {
  try {
    still_of({4000, 3000, exif, xmp});
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

/// North-east-down, of the camera: where it looks, and where the top of its image is.
struct Sight {
  Eigen::Vector3d ahead;
  Eigen::Vector3d up;
};

Sight sight_of(const StillAttitude& attitude) {
  const Eigen::Quaterniond ned_from_camera =
      ned_from_body(attitude.vehicle) * body_from_camera(attitude.mount).rotation;
  return {ned_from_camera * Eigen::Vector3d::UnitZ(), ned_from_camera * -Eigen::Vector3d::UnitY()};
}

Sight sight_of(double roll_deg, double pitch_deg, double yaw_deg) {
  StillAttitude attitude;
  attitude.mount.roll_deg = roll_deg;
  attitude.mount.pitch_deg = pitch_deg;
  attitude.mount.yaw_deg = yaw_deg;
  return sight_of(attitude);
}

void expect_same(const Sight& a, const Sight& b) {
  EXPECT_LT((a.ahead - b.ahead).norm(), 1e-9);
  EXPECT_LT((a.up - b.up).norm(), 1e-9);
}

TEST(Still, PositionHasTheSignsOfItsHemispheres) {
  EXPECT_NEAR(still({}).position.latitude_deg, 46.8428638889, 1e-9);
  EXPECT_NEAR(still({}).position.longitude_deg, -91.9936966667, 1e-9);
  EXPECT_NEAR(still({{"GPSLatitudeRef", "S"}}).position.latitude_deg, -46.8428638889, 1e-9);
}

TEST(Still, PositionOfXMPIsFinerAndCountsWhereBothAgree) {
  const Tags finer{{"drone-dji:GpsLatitude", "46.842863912"}, {"drone-dji:GpsLongtitude", "-91.993696654"}};
  EXPECT_EQ(still({}, finer).position.latitude_deg, 46.842863912);
  const Tags elsewhere{{"drone-dji:GpsLatitude", "12"}, {"drone-dji:GpsLongitude", "13"}};
  EXPECT_NEAR(still({}, elsewhere).position.latitude_deg, 46.8428638889, 1e-9);
}

TEST(Still, WithoutAPlaceOrAFixIsRefusedByName) {
  EXPECT_EQ(fault_of({}), "tells no position");
  EXPECT_EQ(fault_of(joined(kSomewhere, {{"GPSStatus", "V"}})), "says that its receiver had no fix");
  EXPECT_NE(fault_of({{"GPSLatitude", "(0) (0) (0)"}, {"GPSLongitude", "(0) (0) (0)"}}).find("0, 0"),
            std::string::npos);
  EXPECT_NE(fault_of(joined(kSomewhere, {{"GPSLatitude", "(91) (0) (0)"}})).find("beyond the Earth"),
            std::string::npos);
  EXPECT_NE(fault_of(joined(kSomewhere, {{"Orientation", "6"}})).find("Orientation"), std::string::npos);
}

TEST(Still, CameraLooksWhereItsGimbalSaysWhateverTheVehicleDoes) {
  const Tags gimbal{{"drone-dji:GimbalRollDegree", "+2.00"},
                    {"drone-dji:GimbalPitchDegree", "-60.50"},
                    {"drone-dji:GimbalYawDegree", "-140.00"}};
  const Tags tilted{{"drone-dji:FlightRollDegree", "-14.00"},
                    {"drone-dji:FlightPitchDegree", "12.00"},
                    {"drone-dji:FlightYawDegree", "-120.00"}};
  const Sight wanted = sight_of(2.0, -60.5, -140.0);
  expect_same(sight_of(still({}, gimbal).attitude), wanted);
  const StillAttitude attitude = still({}, joined(gimbal, tilted)).attitude;
  expect_same(sight_of(attitude), wanted);
  EXPECT_NEAR(attitude.vehicle.roll_rad, -14.0 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(attitude.yaw_difference_deg.value(), -20.0, 1e-9);
  EXPECT_EQ(attitude.source, AttitudeSource::kCamera);
}

TEST(Still, AttitudesOfAllMakersMeanTheSame) {
  const Sight wanted = sight_of(1.0, -80.0, 30.0);
  for (const Tags& tags : {Tags{{"drone-parrot:CameraRollDegree", "1"},
                                {"drone-parrot:CameraPitchDegree", "-80"},
                                {"drone-parrot:CameraYawDegree", "30"}},
                           Tags{{"drone:GimbalRollDegree", "1"},
                                {"drone:GimbalPitchDegree", "-80"},
                                {"drone:GimbalYawDegree", "30"}},
                           Tags{{"drone-skydio:CameraOrientationNED/Roll", "1"},
                                {"drone-skydio:CameraOrientationNED/Pitch", "-80"},
                                {"drone-skydio:CameraOrientationNED/Yaw", "30"}}})
    expect_same(sight_of(still({}, tags).attitude), wanted);
}

TEST(Still, CameraBelowABodyLooksDownWhereThatIsLevel) {
  const auto sight = [](const char* roll, const char* pitch, const char* make) {
    return sight_of(
        still({{"Make", make}}, {{"Camera:Roll", roll}, {"Camera:Pitch", pitch}, {"Camera:Yaw", "90"}})
            .attitude);
  };
  expect_same(sight("0", "0", "Sentera"), sight_of(0.0, -90.0, 90.0));
  expect_same(sight("0", "90", "Sentera"), sight_of(0.0, 0.0, 90.0));  // forward
  EXPECT_GT(sight("10", "0", "Sentera").ahead.x(),
            0.1);  // right wing down: the camera looks to the left, north
  EXPECT_LT(sight("10", "0", "senseFly").ahead.x(), -0.1);  // counts roll the other way
}

TEST(Still, WithoutAnglesLooksDownWithTheTopToItsHeading) {
  const StillAttitude headed = still({{"GPSImgDirection", "(33.1235)"}}).attitude;
  EXPECT_EQ(headed.source, AttitudeSource::kHeading);
  expect_same(sight_of(headed), sight_of(0.0, -90.0, 33.1235));
  EXPECT_EQ(still({}).attitude.source, AttitudeSource::kNone);
  EXPECT_EQ(still({}, {{"drone-dji:GimbalPitchDegree", "nan"}}).attitude.source, AttitudeSource::kNone);
}

TEST(Still, HeightsHaveTheDatumThatThePictureTells) {
  const Still plain = still({{"GPSAltitude", "(198.409)"}, {"GPSAltitudeRef", "0x00"}},
                            {{"drone-dji:RelativeAltitude", "+39.90"}});
  EXPECT_EQ(plain.height_absolute_m, 198.409);
  EXPECT_EQ(plain.height_above_take_off_m, 39.9);
  EXPECT_EQ(plain.datum, HeightDatum::kMeanSeaLevel);
  EXPECT_EQ(still({{"GPSAltitude", "(3)"}, {"GPSAltitudeRef", "0x01"}}).height_absolute_m, -3.0);
  EXPECT_EQ(still({{"GPSAltitude", "(3)"}, {"GPSAltitudeRef", "0x02"}}).datum, HeightDatum::kEllipsoid);
  const Still rtk = still({}, {{"drone-dji:AbsoluteAltitude", "+87.5"},
                               {"drone-dji:RtkFlag", "50"},
                               {"drone-dji:RtkStdLon", "0.03"},
                               {"drone-dji:RtkStdLat", "0.04"},
                               {"drone-dji:RtkStdHgt", "0.02"}});
  EXPECT_EQ(rtk.height_absolute_m, 87.5);
  EXPECT_EQ(rtk.datum, HeightDatum::kEllipsoid);
  EXPECT_EQ(rtk.rtk_flag, 50);
  EXPECT_DOUBLE_EQ(rtk.sigma_horizontal_m.value(), 0.05);
  EXPECT_EQ(rtk.sigma_height_m, 0.02);
}

TEST(Still, FocalLengthIsTheMostTrustworthyOneTold) {
  const Tags film{{"FocalLengthIn35mmFilm", "24"}};
  const Tags sensor{
      {"FocalLength", "(8.8)"}, {"FocalPlaneXResolution", "(4000)"}, {"FocalPlaneResolutionUnit", "3"}};
  const Tags calibrated{{"drone-dji:CalibratedFocalLength", "3666.67"}};
  const Tags dewarp{
      {"drone-dji:DewarpData", "2020-11-27;3693.65,3690.55,23.5,-12.25,-0.26,0.11,0.0003,-0.0001,-0.03"},
      {"drone-dji:DewarpFlag", "0"}};
  EXPECT_FALSE(still({}).lens);
  EXPECT_NEAR(still(film).lens->intrinsics.fx_px, 24.0 / 34.61 * 4000.0, 1e-9);
  EXPECT_EQ(still(film).lens->source, FocalSource::k35mm);
  EXPECT_NEAR(still(joined(film, sensor)).lens->intrinsics.fx_px, 8.8 * 400.0, 1e-9);
  EXPECT_EQ(still(joined(film, sensor), calibrated).lens->intrinsics.fx_px, 3666.67);
  const CameraIntrinsics lens = still(film, joined(calibrated, dewarp)).lens->intrinsics;
  EXPECT_EQ(lens.fy_px, 3690.55);
  EXPECT_EQ(lens.cx_px, 1999.5 + 23.5);
  EXPECT_EQ(lens.distortion[4], -0.03);
  EXPECT_EQ(still({}, joined(dewarp, {{"drone-dji:DewarpFlag", "1"}})).lens->intrinsics.distortion[0], 0.0);
  EXPECT_FALSE(still({{"FocalLengthIn35mmFilm", "0"}}).lens);
}

TEST(Still, FocalLengthIsTheBetterKnownTheMoreTrustworthyItsSource) {
  EXPECT_GT(sigma_focal_percent(FocalSource::kCalibration), 0.0);
  EXPECT_LT(sigma_focal_percent(FocalSource::kCalibration), sigma_focal_percent(FocalSource::kSensor));
  EXPECT_LT(sigma_focal_percent(FocalSource::kSensor), sigma_focal_percent(FocalSource::k35mm));
}

}  // namespace
}  // namespace geoloc::io
