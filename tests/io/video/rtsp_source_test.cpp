// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/rtsp_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "collecting_taker.hpp"
#include "rtsp_test_server.hpp"

namespace geoloc::io {
namespace {

using std::chrono::milliseconds;
using test::RtspTestServer;
using test::ServerOptions;

/// How long a test waits for what must come; only a faulty system takes so long.
constexpr Duration kPatience = std::chrono::seconds{40};

const HostClock& host_clock() {
  static const HostClock clock;
  return clock;
}

/// The first frame that satisfies the condition.
std::optional<VideoFrame> wait_for(VideoSource& source, const std::function<bool(const VideoFrame&)>& wish) {
  const HostTime begun = host_clock().now();
  while (host_clock().now() - begun < kPatience) {
    auto frame = source.next(milliseconds{200});
    if (frame && wish(*frame)) return frame;
  }
  return std::nullopt;
}

bool wait_for_status(const VideoSource& source, const std::function<bool(const VideoStatus&)>& wish) {
  const HostTime begun = host_clock().now();
  while (host_clock().now() - begun < kPatience) {
    if (wish(source.status())) return true;
    std::this_thread::sleep_for(milliseconds{20});
  }
  return false;
}

bool is_any(const VideoFrame&) {
  return true;
}

double capture_error_s(const VideoFrame& frame) {
  const auto truth = test::stamped_time(frame.bgr);
  return truth ? seconds(frame.captured_at - *truth) : 1e9;
}

double median_capture_error_s(VideoSource& source, TimeQuality quality) {
  std::vector<double> errors;
  while (errors.size() < 11) {
    const auto frame = wait_for(source, [quality](const VideoFrame& f) { return f.time_quality == quality; });
    if (!frame) return 1e9;
    errors.push_back(capture_error_s(*frame));
  }
  std::nth_element(errors.begin(), errors.begin() + 5, errors.end());
  return errors[5];
}

TEST(RtspSource, RecoversTheCaptureTimeFromSenderReports) {
  const RtspTestServer server{{}, host_clock()};
  RtspSource source{server.url(), {}, host_clock()};
  EXPECT_NEAR(median_capture_error_s(source, TimeQuality::kRecovered), 0.0, 0.005);
  const VideoStatus status = source.status();
  EXPECT_EQ(status.state, VideoState::kPlaying);
  EXPECT_EQ(status.time_quality, TimeQuality::kRecovered);
  EXPECT_EQ(status.attempts, 1U);
  EXPECT_EQ(status.lost_packets, 0U);
  EXPECT_EQ(status.last_error, "");
}

TEST(RtspSource, FramesAreNeverCapturedAfterTheyArrive) {
  const RtspTestServer server{{}, host_clock()};
  RtspSource source{server.url(), {}, host_clock()};
  for (int i = 0; i < 20; ++i) {
    const auto frame = wait_for(source, is_any);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->bgr.size(), cv::Size(320, 240));
    EXPECT_EQ(frame->bgr.type(), CV_8UC3);
    EXPECT_LE(frame->captured_at, frame->received_at);
    EXPECT_LE(frame->received_at, host_clock().now());
    EXPECT_EQ(frame->captured_at.time_since_epoch() % std::chrono::microseconds{1}, Duration::zero());
  }
}

TEST(RtspSource, ASendersClockThatIsNotUtcIsToldAndMapped) {
  ServerOptions options;
  options.has_utc = false;
  const RtspTestServer server{options, host_clock()};
  VideoConfig config;
  config.latency_s = 0.003;
  RtspSource source{server.url(), config, host_clock()};
  EXPECT_NEAR(median_capture_error_s(source, TimeQuality::kForeignClock), 0.0, 1.0);
}

TEST(RtspSource, ALostPacketDamagesFramesUpToTheNextKeyFrame) {
  RtspTestServer server{{}, host_clock()};
  RtspSource source{server.url(), {}, host_clock()};
  ASSERT_TRUE(wait_for(source, [](const VideoFrame& frame) { return !frame.damaged; }));
  server.lose_packets(1);
  ASSERT_TRUE(wait_for(source, [](const VideoFrame& frame) { return frame.damaged; }));
  ASSERT_TRUE(wait_for(source, [](const VideoFrame& frame) { return !frame.damaged; }));
  EXPECT_GE(source.status().lost_packets, 1U);
  EXPECT_GE(source.status().damaged, 1U);
}

TEST(RtspSource, ASlowCallerGetsTheNewestFrame) {
  const RtspTestServer server{{}, host_clock()};
  RtspSource source{server.url(), {}, host_clock()};
  const auto early = wait_for(source, is_any);
  ASSERT_TRUE(early);
  ASSERT_TRUE(wait_for_status(source, [](const VideoStatus& status) { return status.frames >= 15; }));
  const auto late = source.next(kPatience);
  ASSERT_TRUE(late);
  EXPECT_GE(late->captured_at - early->captured_at,
            milliseconds{400});  // fourteen frames, whose stamps may be late on a busy machine
  EXPECT_GE(source.status().dropped, 10U);
}

TEST(RtspSource, ReconnectsWhenTheServerDiesAndComesBack) {
  ServerOptions options;
  auto server = std::make_unique<RtspTestServer>(options, host_clock());
  options.port = server->port();
  const auto taker = std::make_shared<test::CollectingTaker>();
  RtspSource source{server->url(), {}, host_clock(), taker};
  const HostTime begun = host_clock().now();
  ASSERT_TRUE(wait_for(source, is_any));
  server.reset();
  ASSERT_TRUE(wait_for_status(
      source, [](const VideoStatus& status) { return status.state == VideoState::kRetrying; }));
  EXPECT_NE(source.status().last_error, "");

  server = std::make_unique<RtspTestServer>(options, host_clock());
  const HostTime back_at = host_clock().now();
  ASSERT_TRUE(wait_for(source, [back_at](const VideoFrame& frame) { return frame.received_at > back_at; }));
  EXPECT_EQ(source.status().state, VideoState::kPlaying);
  EXPECT_GE(source.status().attempts, 2U);

  // The video that is handed on goes on in its own time.
  EXPECT_TRUE(taker->knows_all_frames());
  const auto pictures = taker->pictures();
  EXPECT_TRUE(std::is_sorted(pictures.begin(), pictures.end(),
                             [](const auto& a, const auto& b) { return a.shown_at < b.shown_at; }));
  EXPECT_GT(pictures.back().shown_at, back_at - begun);
}

TEST(RtspSource, AFrozenServerIsLeftAndTriedAnew) {
  RtspTestServer server{{}, host_clock()};
  VideoConfig config;
  config.frame_timeout_s = 0.5;
  RtspSource source{server.url(), config, host_clock()};
  ASSERT_TRUE(wait_for(source, is_any));
  server.freeze(true);
  ASSERT_TRUE(wait_for_status(
      source, [](const VideoStatus& status) { return status.state == VideoState::kRetrying; }));
  EXPECT_EQ(source.status().last_error, server.url() + ": no frame for 0.5 s");

  server.freeze(false);
  const HostTime thawed_at = host_clock().now();
  EXPECT_TRUE(
      wait_for(source, [thawed_at](const VideoFrame& frame) { return frame.received_at > thawed_at; }));
}

TEST(RtspSource, PicturesMayChangeTheirSizeInFlight) {
  RtspTestServer server{{}, host_clock()};
  RtspSource source{server.url(), {}, host_clock()};
  ASSERT_TRUE(wait_for(source, [](const VideoFrame& frame) { return frame.bgr.cols == 320; }));
  server.resize(480, 160);
  ASSERT_TRUE(
      wait_for(source, [](const VideoFrame& frame) { return frame.bgr.size() == cv::Size(480, 160); }));
  EXPECT_EQ(source.status().attempts, 1U);
}

TEST(RtspSource, RefusesPicturesBeyondTheLimit) {
  const RtspTestServer server{{}, host_clock()};
  VideoConfig config;
  config.max_megapixels = 0.05;
  RtspSource source{server.url(), config, host_clock()};
  ASSERT_TRUE(wait_for_status(source, [](const VideoStatus& status) { return status.attempts >= 3; }));
  EXPECT_GE(source.status().refused, 2U);
  EXPECT_EQ(source.status().frames, 0U);
  EXPECT_NE(source.status().last_error.find("320 x 240"), std::string::npos) << source.status().last_error;
}

TEST(RtspSource, ReceivesOverUdp) {
  const RtspTestServer server{{}, host_clock()};
  VideoConfig config;
  config.transport = RtspTransport::kUdp;
  RtspSource source{server.url(), config, host_clock()};
  EXPECT_TRUE(wait_for(
      source, [](const VideoFrame& frame) { return frame.time_quality == TimeQuality::kRecovered; }));
}

TEST(RtspSource, ReceivesH265) {
  ServerOptions options;
  options.encoder = "x265enc tune=zerolatency speed-preset=ultrafast key-int-max=10 ! h265parse ! rtph265pay";
  const RtspTestServer server{options, host_clock()};
  RtspSource source{server.url(), {}, host_clock()};
  EXPECT_TRUE(wait_for(source, [](const VideoFrame& frame) { return !frame.damaged; }));
}

TEST(RtspSource, RefusesWhatCannotBeAnAddressWithoutShowingThePassword) {
  try {
    const RtspSource source{"http://pilot:secret@camera/stream", {}, host_clock()};
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string{error.what()}.find("secret"), std::string::npos);
  }
  VideoConfig config;
  config.latency_s = -1;
  EXPECT_THROW(RtspSource("rtsp://camera/stream", config, host_clock()), std::invalid_argument);
}

}  // namespace
}  // namespace geoloc::io
