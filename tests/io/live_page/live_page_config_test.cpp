// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_page_config.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "io/live_page/live_page_fields.hpp"
#include "support/setting_bounds.hpp"

namespace geoloc::io {
namespace {

TEST(HttpEndpoint, IsThisComputerAloneUnlessAHostIsGiven) {
  EXPECT_EQ(parse_http_endpoint("8080").host, "127.0.0.1");
  EXPECT_EQ(parse_http_endpoint("8080").port, 8080);
  EXPECT_EQ(parse_http_endpoint("0.0.0.0:80").host, "0.0.0.0");
  EXPECT_EQ(parse_http_endpoint("drone.local:65535").host, "drone.local");
  EXPECT_EQ(parse_http_endpoint("[::1]:1").host, "::1");
}

TEST(HttpEndpoint, RefusesWhatIsNone) {
  for (const char* text :
       {"", ":", "port", "65536", "-1", "80 ", ":80", "a b:80", "::1:80", "http://x:80", "[]:80"})
    EXPECT_THROW(parse_http_endpoint(text), std::invalid_argument) << text;
}

TEST(TileUrl, NamesTheOriginThatThePageMayLoadFrom) {
  EXPECT_EQ(tile_origin("https://tiles.example.org:8443/{z}/{x}/{y}.png?k=1"),
            "https://tiles.example.org:8443");
  for (const char* text : {"", "ftp://a/{z}/{x}/{y}", "https://a/{z}/{x}", "https:///{z}/{x}/{y}",
                           "https://a; script-src *//{z}/{x}/{y}", "https://{z}/{x}/{y}"})
    EXPECT_EQ(tile_origin(text), "") << text;
}

TEST(LivePageConfig, NamesEveryFaultByItsPath) {
  EXPECT_TRUE(LivePageConfig{}.problems().empty());
  LivePageConfig config;
  config.max_pages = 0;
  config.update_period_s = std::nan("");
  config.write_timeout_s = 1e9;
  config.picture_width_px = 0;
  config.picture_period_s = -1.0;
  config.tile_url = "file:///etc/passwd";
  EXPECT_EQ(config.problems().size(), 6U);
}

TEST(LivePageConfig, KeepsEveryBoundThatItsDescriptionNames) {
  EXPECT_GT(geoloc::testing::expect_bounds_are_kept<LivePageConfig>(), 0U);
}

}  // namespace
}  // namespace geoloc::io
