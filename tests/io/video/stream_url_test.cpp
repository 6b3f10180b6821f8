// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/stream_url.hpp"

#include <gtest/gtest.h>

namespace geoloc::io {
namespace {

TEST(StreamUrl, IsAnRtspAddressWithAHost) {
  for (const char* url :
       {"rtsp://camera", "rtsp://192.168.1.4:8554/main", "rtsps://u:p@camera/x?y=1", "rtspt://[::1]:554/a"}) {
    EXPECT_TRUE(is_rtsp_url(url)) << url;
  }
  for (const char* url : {"", "camera", "http://camera/", "rtsp://", "rtsp://:554/x", "rtsp://u:p@/x",
                          "rtsp://camera/a b", "rtsp://camera/\n", "RTSP//camera"}) {
    EXPECT_FALSE(is_rtsp_url(url)) << url;
  }
}

TEST(StreamUrl, ShowsNoCredentials) {
  EXPECT_EQ(without_credentials("rtsp://192.168.1.4:8554/main"), "rtsp://192.168.1.4:8554/main");
  EXPECT_EQ(without_credentials("rtsp://pilot:secret@camera:554/main"), "rtsp://…@camera:554/main");
  EXPECT_EQ(without_credentials("rtsp://pilot:se/cr@et@camera/main"), "rtsp://…@camera/main");
  EXPECT_EQ(without_credentials("rtsp://camera/main?user=a&password=b"), "rtsp://camera/main…");
  EXPECT_EQ(without_credentials("rtsp://camera/live/user=admin_password=b_channel=1.sdp"),
            "rtsp://camera/live/…");
}

TEST(StreamUrl, HidesThemInWhatOthersSay) {
  const std::string url = "rtsp://pilot:secret@camera/main?token=abc";
  EXPECT_EQ(without_credentials_of(url, "cannot open rtsp://pilot:secret@camera/main?token=abc"),
            "cannot open rtsp://…@camera/main…");
  EXPECT_EQ(without_credentials_of(url, "user pilot:secret, password secret, ?token=abc"),
            "user …, password …, …");
  EXPECT_EQ(without_credentials_of("rtsp://camera/main", "Not Found (404)"), "Not Found (404)");
}

}  // namespace
}  // namespace geoloc::io
