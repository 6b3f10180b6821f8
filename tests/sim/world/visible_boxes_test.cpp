// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/world/visible_boxes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "sim/world/drawn_object.hpp"

namespace geoloc::sim {
namespace {

PlacedObject target_at(double east_m, double north_m, double heading_rad = 0.0) {
  PlacedObject target;
  target.position_in_enu = {east_m, north_m};
  target.heading_rad = heading_rad;
  return target;
}

TEST(VisibleBoxes, SurroundTheDrawnTarget) {
  const Rigid3d enu_from_camera = pose_above(15.0, 10.0, 20.0, 70.0);
  for (const double heading_rad : {0.0, 0.4, 0.8}) {
    const PlacedObject target = target_at(5.0, 2.0, heading_rad);
    const auto boxes = visible_boxes(CameraModel(barrel_camera()), enu_from_camera, {target});
    ASSERT_EQ(boxes.size(), 1u);
    const cv::Mat drawn = drawn_object(barrel_camera(), target, enu_from_camera) > 12.0;
    const cv::Rect found = cv::boundingRect(drawn);  // edges in the box's coordinates: a pixel is one unit
    const Box& box = boxes[0].box;
    EXPECT_NEAR(box.x, found.x, 1.6);
    EXPECT_NEAR(box.y, found.y, 1.6);
    EXPECT_NEAR(box.x + box.width, found.x + found.width, 1.6);
    EXPECT_NEAR(box.y + box.height, found.y + found.height, 1.6);
  }
}

TEST(VisibleBoxes, HaveTheTargetsCentreInTheirMiddle) {
  const CameraModel camera(barrel_camera());
  for (const double tilt_deg : {0.0, 20.0, 40.0}) {
    for (double heading_rad = 0.0; heading_rad < 1.6; heading_rad += 0.2) {
      const Rigid3d enu_from_camera = pose_above(20.0, 0.0, tilt_deg, 0.0);
      const double ahead_m = 20.0 * std::tan(tilt_deg * M_PI / 180.0);
      const auto boxes = visible_boxes(camera, enu_from_camera, {target_at(2.0, ahead_m, heading_rad)});
      ASSERT_EQ(boxes.size(), 1u);
      EXPECT_LT((boxes[0].whole.centre() - boxes[0].centre_px).norm(), 0.01 * boxes[0].whole.width);
    }
  }
}

TEST(VisibleBoxes, AreCutAtTheImagesEdge) {
  const CameraModel camera{CameraIntrinsics{}};
  const Rigid3d enu_from_camera = pose_above(20.0, 0.0, 0.0, 0.0);
  const double edge_m = 640.0 / 914.01 * 20.0;
  const auto boxes = visible_boxes(camera, enu_from_camera, {target_at(edge_m, 0.0)});
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_NEAR(boxes[0].visible_fraction, 0.5, 1e-3);
  EXPECT_NEAR(boxes[0].box.x + boxes[0].box.width, 1280.0, 1e-9);
  EXPECT_NEAR(boxes[0].whole.width, 2.0 * boxes[0].box.width, 0.1);
}

TEST(VisibleBoxes, ListOnlyTargetsInView) {
  const CameraModel camera{CameraIntrinsics{}};
  PlacedObject tyre = target_at(0.0, 0.0);
  tyre.kind = ObjectKind::kTyre;
  const std::vector<PlacedObject> objects{tyre, target_at(100.0, 0.0), target_at(1.0, 1.0)};
  const auto boxes = visible_boxes(camera, pose_above(20.0, 0.0, 0.0, 0.0), objects);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].object_index, 2u);
  EXPECT_TRUE(visible_boxes(camera, pose_above(20.0, 180.0, 0.0, 0.0), objects).empty());
  EXPECT_TRUE(visible_boxes(camera, pose_above(-20.0, 180.0, 0.0, 0.0), objects).empty());
  EXPECT_TRUE(visible_boxes(camera, pose_above(std::nan(""), 0.0, 0.0, 0.0), objects).empty());
}

}  // namespace
}  // namespace geoloc::sim
