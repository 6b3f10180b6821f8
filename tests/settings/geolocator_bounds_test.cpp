// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "pipeline/geolocator_fields.hpp"
#include "support/setting_bounds.hpp"

namespace geoloc {
namespace {

TEST(GeolocatorConfig, KeepsEveryBoundThatItsDescriptionNames) {
  EXPECT_GT(testing::expect_bounds_are_kept<GeolocatorConfig>(), 350U);
}

TEST(GeolocatorConfig, NamesTheSettingOfAStageByItsPath) {
  GeolocatorConfig config;
  config.joint.gate = -1.0;
  config.joint.drift.max_nodes = 3;
  config.camera.mount.pitch_deg = 400.0;
  EXPECT_EQ(config.problems(),
            (std::vector<std::string>{"joint.drift.max_nodes must lie in [4, 500], but is 3",
                                      "joint.gate must lie in (0, 1000], but is -1",
                                      "camera.mount.pitch_deg must lie in [-360, 360], but is 400"}));
}

TEST(GeolocatorConfig, RefusesMarginsThatLeaveNothingOfTheImage) {
  GeolocatorConfig config;
  config.camera.intrinsics = CameraIntrinsics::from_field_of_view(640, 480, 60.0);
  config.edge_margin_px = 239.9;
  EXPECT_EQ(config.problems(), std::vector<std::string>{});
  config.method = Method::kPaper;
  config.edge_margin_px = config.paper.visible_margin_px = 240.0;
  EXPECT_EQ(
      config.problems(),
      (std::vector<std::string>{
          "edge_margin_px must be less than half of the image's width and height, but is 240",
          "paper.visible_margin_px must be less than half of the image's width and height, but is 240"}));
}

TEST(StageConfig, KeepsEveryBoundOnItsOwn) {
  EXPECT_GT(testing::expect_bounds_are_kept<StateConfig>(), 0U);
  EXPECT_GT(testing::expect_bounds_are_kept<ProjectorConfig>(), 0U);
  EXPECT_GT(testing::expect_bounds_are_kept<CameraConfig>(), 0U);
  EXPECT_GT(testing::expect_bounds_are_kept<PaperTrackerConfig>(), 0U);
  EXPECT_GT(testing::expect_bounds_are_kept<CalibrationPrior>(), 0U);
  EXPECT_GT(testing::expect_bounds_are_kept<DriftConfig>(), 0U);
  EXPECT_GT(testing::expect_bounds_are_kept<MovingConfig>(), 0U);
  EXPECT_GT(testing::expect_bounds_are_kept<JointTrackerConfig>(), 0U);
  EXPECT_GT(testing::expect_bounds_are_kept<KnownPoint>(), 0U);
}

}  // namespace
}  // namespace geoloc
