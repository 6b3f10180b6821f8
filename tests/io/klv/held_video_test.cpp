// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/klv/held_video.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace geoloc::io {
namespace {

using std::chrono::milliseconds;

EncodedPicture picture_at(int time_ms, std::size_t bytes = 1) {
  return {"video/x-h264", std::string(bytes, 'x'), milliseconds{time_ms}, {}};
}

std::vector<int> times_ms(const HeldVideo::Pictures& pictures) {
  std::vector<int> times;
  for (const EncodedPicture& picture : pictures)
    times.push_back(static_cast<int>(picture.shown_at / milliseconds{1}));
  return times;
}

using Times = std::vector<int>;

TEST(HeldVideo, GivesPicturesThroughTheOneThatIsKnown) {
  HeldVideo video;
  for (const int time_ms : {0, 33, 67, 100}) video.add(picture_at(time_ms));
  EXPECT_EQ(times_ms(video.take_through(milliseconds{67})), (Times{0, 33, 67}));
  EXPECT_EQ(times_ms(video.take_through(milliseconds{67})), Times{});
  EXPECT_EQ(times_ms(video.take_all()), Times{100});
}

TEST(HeldVideo, KeepsTheOrderOfDecodingWherePicturesChangePlaces) {
  HeldVideo video;
  for (const int time_ms : {0, 100, 33, 67, 200, 133, 167}) video.add(picture_at(time_ms));
  EXPECT_EQ(times_ms(video.take_through(milliseconds{33})), (Times{0, 100, 33}));
  EXPECT_EQ(times_ms(video.take_through(milliseconds{133})), (Times{67, 200, 133}));
}

TEST(HeldVideo, KnowsWhenAFrameIsShown) {
  HeldVideo video;
  const HostTime captured_at{std::chrono::seconds{5}};
  video.note_frame(captured_at, milliseconds{40});
  EXPECT_EQ(video.shown_at(captured_at), Duration{milliseconds{40}});
  EXPECT_EQ(video.shown_at(captured_at + Duration{1}), std::nullopt);
}

TEST(HeldVideo, DoesNotWaitForEverForFramesThatNobodyLocates) {
  HeldVideo video;
  for (const int time_ms : {0, 500, 1000, 3000}) video.add(picture_at(time_ms));
  EXPECT_EQ(times_ms(video.take_overdue()), Times{});
  video.note_frame(HostTime{}, milliseconds{1000} + HeldVideo::kLongestHold);
  EXPECT_EQ(times_ms(video.take_overdue()), (Times{0, 500, 1000}));
}

TEST(HeldVideo, LosesTheOldestWhereNobodyTakesThem) {
  HeldVideo video;
  const std::size_t large = HeldVideo::kMostHeld_bytes / 4;
  for (int i = 0; i < 7; ++i) video.add(picture_at(i, large));
  EXPECT_EQ(video.take_lost(), 3U);
  EXPECT_EQ(video.take_lost(), 0U);
  EXPECT_EQ(times_ms(video.take_all()), (Times{3, 4, 5, 6}));
}

}  // namespace
}  // namespace geoloc::io
