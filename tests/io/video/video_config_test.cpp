// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/video_config.hpp"

#include <gtest/gtest.h>

#include "io/video/video_fields.hpp"
#include "support/setting_bounds.hpp"

namespace geoloc::io {
namespace {

TEST(VideoConfig, KeepsEveryBoundThatItsDescriptionNames) {
  EXPECT_GT(testing::expect_bounds_are_kept<VideoConfig>(), 0U);
}

TEST(VideoConfig, RetriesNoSoonerAtTheEndThanAtTheBeginning) {
  EXPECT_TRUE(VideoConfig{}.problems().empty());
  VideoConfig config;
  config.retry_min_s = config.retry_max_s = 2.0;
  EXPECT_TRUE(config.problems().empty());
  config.retry_max_s = 1.5;
  EXPECT_EQ(config.problems(),
            std::vector<std::string>{"retry_max_s must be at least retry_min_s, but is 1.5"});
}

}  // namespace
}  // namespace geoloc::io
