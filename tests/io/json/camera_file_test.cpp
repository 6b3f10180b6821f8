// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/json/camera_file.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "geoloc/io/json/camera_fields.hpp"
#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

// What OpenCV's FileStorage writes (samples/cpp/calibration.cpp).
constexpr const char* kOpenCv = R"(%YAML:1.0
---
calibration_time: "Sun Nov 22 2026"
image_width: 1920
image_height: 1080
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 1402.5, 0., 958.2, 0., 1401.1, 541.7, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -0.11, 0.05, 0.001, -0.002, 0.003 ]
)";

// What ROS' camera_calibration writes.
constexpr const char* kRos = R"(image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [438.783367, 0.0, 305.593336, 0.0, 437.302876, 243.738352, 0.0, 0.0, 1.0]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.361976, 0.110510, 0.001014, 0.000505, 0.0]
)";

TEST(CameraFile, ReadsOpenCvsYaml) {
  CameraConfig defaults;
  defaults.mount.pitch_deg = -45.0;
  const CameraConfig camera = camera_from_yaml(kOpenCv, "calibration.yml", defaults);
  EXPECT_EQ(camera.intrinsics.width_px, 1920);
  EXPECT_DOUBLE_EQ(camera.intrinsics.fy_px, 1401.1);
  EXPECT_DOUBLE_EQ(camera.intrinsics.cy_px, 541.7);
  EXPECT_DOUBLE_EQ(camera.intrinsics.distortion[4], 0.003);
  EXPECT_DOUBLE_EQ(camera.mount.pitch_deg, -45.0);
}

TEST(CameraFile, ReadsRosYaml) {
  const CameraConfig camera = camera_from_yaml(kRos, "ost.yaml", {});
  EXPECT_EQ(camera.intrinsics.height_px, 480);
  EXPECT_DOUBLE_EQ(camera.intrinsics.fx_px, 438.783367);
  EXPECT_DOUBLE_EQ(camera.intrinsics.distortion[0], -0.361976);
}

TEST(CameraFile, RefusesModelsItDoesNotHaveAndYamlThatIsNone) {
  std::string equidistant = kRos;
  equidistant.replace(equidistant.find("plumb_bob"), 9, "equidistant");
  EXPECT_THROW(camera_from_yaml(equidistant, "x", {}), std::runtime_error);
  for (const char* text :
       {"", "[1, 2", "image_width: 3", "a: b: c", "image_width: x\nimage_height: 1\ncamera_matrix: 1",
        "image_width: 1\nimage_height: 1\ncamera_matrix: {data: [1]}"}) {
    EXPECT_THROW(camera_from_yaml(text, "x", {}), std::runtime_error) << text;
  }
}

TEST(CameraFile, JsonGoesThereAndBack) {
  const testing::TemporaryFolder folder;
  CameraConfig camera;
  camera.intrinsics.distortion = {0.1, -0.2, 0.3, -0.4, 0.5};
  camera.mount = {1, -80, 3, 0.4, 0.5, 0.6};
  const auto file = folder.write("camera.json", camera_to_json(camera).dump());
  const CameraConfig back = read_camera_file(file);
  EXPECT_EQ(camera_to_json(back), camera_to_json(camera));
}

TEST(CameraFile, TakesAFieldOfViewAndExtraKeys) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write(
      "camera.json", R"({"width": 640, "height": 480, "horizontal_fov_deg": 90, "vendor": "acme"})");
  const CameraConfig camera = read_camera_file(file);
  EXPECT_NEAR(camera.intrinsics.fx_px, 320.0, 1e-9);
  EXPECT_NEAR(camera.intrinsics.cx_px, 319.5, 1e-9);
}

TEST(CameraFile, NamesTheFileAndEveryFault) {
  const testing::TemporaryFolder folder;
  const auto file =
      folder.write("camera.json", R"({"width": -1, "height": 480, "fx": "wide", "fy": 1, "cx": 1})");
  try {
    read_camera_file(file);
    FAIL() << "a broken camera was taken";
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("camera.json"), std::string::npos);
    EXPECT_NE(message.find("cy is missing"), std::string::npos);
    EXPECT_NE(message.find("fx must be"), std::string::npos);
  }
  EXPECT_THROW(read_camera_file(folder.path() / "none.json"), std::runtime_error);
}

CameraConfig camera_of(const nlohmann::json& object, const CameraConfig& before = {}) {
  CameraConfig camera = before;
  std::vector<std::string> problems;
  camera_from_json(object, "camera", true, camera, problems);
  EXPECT_TRUE(problems.empty()) << problems.front();
  return camera;
}

TEST(CameraMount, OnAGimbalLooksWhereThatSaysUnlessItsAnglesAreGiven) {
  const CameraMount plain = camera_of({{"mount", {{"kind", "gimbal"}}}}).mount;
  EXPECT_EQ(plain.kind, MountKind::kGimbal);
  EXPECT_EQ(plain.pitch_deg, 0.0);
  const CameraMount turned =
      camera_of({{"mount", {{"kind", "gimbal"}, {"pitch_deg", 1.5}, {"x_m", 0.2}}}}).mount;
  EXPECT_EQ(turned.pitch_deg, 1.5);
  EXPECT_EQ(turned.x_m, 0.2);
  const CameraMount fixed = camera_of({{"mount", {{"kind", "fixed"}}}}).mount;
  EXPECT_EQ(fixed.pitch_deg, -90.0);
}

TEST(CameraMount, OnAGimbalIsReadOverAnotherFileWithWhatThatSaysOfIt) {
  const CameraConfig first = camera_of({{"mount", {{"kind", "gimbal"}, {"roll_deg", 0.7}}}});
  EXPECT_EQ(camera_of({{"mount", {{"kind", "gimbal"}, {"yaw_deg", 2.0}}}}, first).mount.roll_deg, 0.7);
  CameraConfig oblique;
  oblique.mount.pitch_deg = -45.0;
  EXPECT_EQ(camera_of({{"mount", {{"kind", "gimbal"}}}}, oblique).mount.pitch_deg, 0.0)
      << "angles in the body mean nothing in the gimbal";
}

TEST(CameraMount, IsWrittenSoThatItIsReadBack) {
  CameraConfig camera;
  camera.mount = CameraMount::on_gimbal();
  camera.mount.yaw_deg = 3.0;
  const CameraConfig again = camera_of(camera_to_json(camera));
  EXPECT_EQ(again.mount.kind, MountKind::kGimbal);
  EXPECT_EQ(again.mount.pitch_deg, 0.0);
  EXPECT_EQ(again.mount.yaw_deg, 3.0);
}

TEST(CameraMount, OfAnUnknownKindIsRefused) {
  for (const nlohmann::json& kind : {nlohmann::json("gymbal"), nlohmann::json(1), nlohmann::json()}) {
    CameraConfig camera;
    std::vector<std::string> problems;
    camera_from_json({{"mount", {{"kind", kind}}}}, "camera", true, camera, problems);
    ASSERT_EQ(problems.size(), 1U) << kind;
    EXPECT_NE(problems[0].find("camera.mount.kind must be one of: fixed, gimbal"), std::string::npos);
  }
}

}  // namespace
}  // namespace geoloc::io
