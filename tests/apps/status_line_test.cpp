// SPDX-License-Identifier: Apache-2.0
#include "app/status_line.hpp"

#include <gtest/gtest.h>

#include "app/video_tally.hpp"

namespace geoloc::apps {
namespace {

io::LiveStatus usual_status() {
  io::LiveStatus status;
  status.elapsed = std::chrono::seconds{3 * 60 + 35};
  status.objects = 30;
  status.tentative = 6;
  status.attitude_rate_hz = 60.2;
  status.position_rate_hz = 59.8;
  status.video_state = "playing";
  status.video_rate_hz = 15.0;
  status.frame_time = "recovered";
  status.latency_ms = 123.0;
  status.frames = 1410;
  status.frames_unusable = 20;
  status.frames_searched = 1410;
  return status;
}

TEST(StatusLine, IsWordsAndFitsATerminal) {
  EXPECT_EQ(status_line(usual_status()),
            "03:35  objects 30  telemetry 60/s  video 15/s, located 99 %  delay 0.1 s");
  io::LiveStatus slow = usual_status();
  slow.frames_dropped = 1590;
  EXPECT_EQ(status_line(slow), "03:35  objects 30  telemetry 60/s  video 15/s, searched 47 %, located 99 %");
  io::LiveStatus damaged = usual_status();
  damaged.frames_damaged = 12;
  EXPECT_EQ(status_line(damaged), "03:35  objects 30  telemetry 60/s  video 15/s, 12 damaged, located 99 %");
  for (const io::LiveStatus& status : {usual_status(), slow, damaged})
    EXPECT_LT(status_line(status).size(), 80U) << status_line(status);
}

TEST(StatusLine, NamesAVideoThatDoesNotPlay) {
  io::LiveStatus status;
  status.video_state = "retrying";
  EXPECT_EQ(status_line(status), "00:00  objects 0  telemetry 0/s  video retrying");
}

TEST(VideoTally, SaysThatAComputerIsTooSlow) {
  EXPECT_EQ(slowness({0, 0, 0.0}), "");
  EXPECT_EQ(slowness({280, 5, 60.0}), "");
  EXPECT_EQ(
      slowness({133, 147, 250.0}),
      "searched 133 of 280 frames, 250 ms each: the stream is too fast for this computer, so objects may "
      "be missed. A lower frame rate, a smaller --model or --backend openvino help");
}

}  // namespace
}  // namespace geoloc::apps
