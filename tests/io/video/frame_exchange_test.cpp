// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/frame_exchange.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace geoloc::io {
namespace {

using std::chrono::milliseconds;

constexpr HostTime kStart{std::chrono::seconds{1'790'000'000}};

VideoFrame frame(int number) {
  VideoFrame made;
  made.bgr = cv::Mat{1, 1, CV_8UC3, cv::Scalar::all(number)};
  made.captured_at = made.received_at = kStart + number * milliseconds{100};
  return made;
}

int number_of(const std::optional<VideoFrame>& frame) {
  return frame ? frame->bgr.at<cv::Vec3b>(0, 0)[0] : -1;
}

TEST(FrameExchange, GivesTheNewestFrameOnceAndCountsWhatNobodyTook) {
  FrameExchange exchange;
  for (int i = 0; i < 5; ++i) exchange.offer(frame(i));
  EXPECT_EQ(number_of(exchange.take(Duration::zero())), 4);
  EXPECT_FALSE(exchange.take(Duration::zero()));
  EXPECT_EQ(exchange.status(kStart).dropped, 4U);
  EXPECT_EQ(exchange.status(kStart).frames, 5U);
}

TEST(FrameExchange, LosesNothingWhereTheProducerWaits) {
  FrameExchange exchange;
  std::thread producer{[&exchange] {
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(exchange.offer_and_wait(frame(i)));
    exchange.end();
  }};
  for (int i = 0; i < 100; ++i) EXPECT_EQ(number_of(exchange.take(std::chrono::minutes{1})), i);
  producer.join();
  EXPECT_FALSE(exchange.take(Duration::max()));  // at once, as it has ended
  EXPECT_EQ(exchange.status(kStart).dropped, 0U);
}

TEST(FrameExchange, TheEndFreesWhoeverWaits) {
  FrameExchange exchange;
  exchange.offer(frame(1));
  std::thread producer{[&exchange] { EXPECT_FALSE(exchange.offer_and_wait(frame(2))); }};
  exchange.end();
  producer.join();
  EXPECT_EQ(number_of(exchange.take(Duration::zero())), 1);
  exchange.offer(frame(3));
  exchange.set_state(VideoState::kRetrying);
  EXPECT_FALSE(exchange.take(Duration::zero()));
  EXPECT_EQ(exchange.status(kStart).state, VideoState::kEnded);
}

TEST(FrameExchange, MeasuresTheRateOfTheLastSeconds) {
  FrameExchange exchange;
  for (int i = 0; i <= 50; ++i) exchange.offer(frame(i));
  EXPECT_NEAR(exchange.status(kStart + milliseconds{5000}).frames_per_second, 10.0, 0.6);
  EXPECT_EQ(exchange.status(kStart + milliseconds{9000}).frames_per_second, 0.0);
}

}  // namespace
}  // namespace geoloc::io
