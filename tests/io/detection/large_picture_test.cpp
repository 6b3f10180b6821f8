// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/attitude.hpp"
#include "geoloc/io/detection/yolo_decode.hpp"
#include "geoloc/io/detection/yolo_detector.hpp"
#include "geoloc/sim/world/camera_renderer.hpp"
#include "geoloc/sim/world/visible_boxes.hpp"
#include "support/source_tree.hpp"

namespace geoloc::io {
namespace {

constexpr double kTarget_px = 10.0;

struct LargePicture {
  cv::Mat bgr;
  std::vector<sim::VisibleBox> targets;
};

/// 3840 x 2160 px, looking straight down on targets of kTarget_px.
LargePicture make_large_picture() {
  const CameraIntrinsics intrinsics = CameraIntrinsics::from_field_of_view(3840, 2160, 70.0);
  const double height_m = sim::kFiducialSize_m * intrinsics.fx_px / kTarget_px;
  const Rigid3d enu_from_body{enu_from_ned() * ned_from_body(EulerAngles{}), {0.0, 0.0, height_m}};
  const Rigid3d enu_from_camera = enu_from_body * body_from_camera({});
  sim::Scene scene;
  for (const double east_m : {-60.0, -25.7, 0.0, 26.3, 61.0}) {
    sim::PlacedObject target;
    target.position_in_enu = {east_m, 0.4 * east_m + 7.0};
    scene.objects.push_back(target);
  }
  LargePicture picture;
  sim::CameraRenderer(intrinsics, scene).render(enu_from_camera, {0.0, 0.0}, picture.bgr);
  picture.targets = sim::visible_boxes(CameraModel(intrinsics), enu_from_camera, scene.objects);
  return picture;
}

std::size_t found(const LargePicture& picture, const DetectionConfig& config) {
  const auto model = source_tree() / "data/models/fiducial.onnx";
  const auto detections = open_detector({model, {}}, config)->detect(picture.bgr);
  std::size_t matched = 0;
  for (const sim::VisibleBox& target : picture.targets) {
    for (const Detection& detection : detections)
      matched += intersection_over_union(target.box, detection.box) > 0.5 ? 1U : 0U;
  }
  return matched;
}

TEST(LargePicture, ShowsTargetsOf10PxInItsTilesAndNotAsAWhole) {
  const LargePicture picture = make_large_picture();
  ASSERT_EQ(picture.targets.size(), 5U);
  DetectionConfig config;
  EXPECT_LT(found(picture, config), 5U);
  config.tile_columns = 3;
  config.tile_rows = 3;
  EXPECT_EQ(found(picture, config), 5U);
}

}  // namespace
}  // namespace geoloc::io
