// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/camera_clock.hpp"

#include <gtest/gtest.h>

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

constexpr HostTime kNow{std::chrono::seconds{1'790'000'000}};

CameraTime camera_at(HostTime host, Duration ahead) {
  return CameraTime{host.time_since_epoch() + ahead};
}

TEST(CameraClock, RightClocksKeepTheirTimes) {
  for (const Duration ahead : {-2900ms, -100ms, 0ms, 400ms}) {
    CameraClock clock;
    for (const Duration later : {0ms, 40ms, 80ms})
      EXPECT_EQ(clock.to_host(camera_at(kNow + later, ahead), kNow + later), kNow + later + ahead);
  }
}

TEST(CameraClock, OfAnotherClockTheFirstFrameWasMadeWhenItCame) {
  for (const Duration ahead : std::initializer_list<Duration>{-500'000h, -4s, 2s, 24h}) {
    CameraClock clock;
    EXPECT_EQ(clock.to_host(camera_at(kNow, ahead), kNow), kNow);
    EXPECT_EQ(clock.to_host(camera_at(kNow + 33ms, ahead), kNow + 90ms), kNow + 33ms);  // delayed
    EXPECT_EQ(clock.to_host(camera_at(kNow + 66ms, ahead), kNow + 91ms), kNow + 66ms);
  }
}

TEST(CameraClock, StalledStreamsAreNoReasonToBeginAnew) {
  CameraClock clock;
  clock.to_host(camera_at(kNow, 0ms), kNow);
  EXPECT_EQ(clock.to_host(camera_at(kNow + 40ms, 0ms), kNow + 20s), kNow + 40ms);
  EXPECT_EQ(clock.to_host(camera_at(kNow + 20s, 0ms), kNow + 20s), kNow + 20s);
}

TEST(CameraClock, ClocksThatAreSetAnewBeginAnew) {
  for (const Duration ahead : std::initializer_list<Duration>{24h * 365, -24h}) {
    CameraClock clock;
    EXPECT_EQ(clock.to_host(camera_at(kNow, -20h), kNow), kNow);
    EXPECT_EQ(clock.to_host(camera_at(kNow + 1s, -20h + ahead), kNow + 1s), kNow + 1s);
    EXPECT_EQ(clock.to_host(camera_at(kNow + 2s, -20h + ahead), kNow + 2s), kNow + 2s);
  }
}

}  // namespace
}  // namespace geoloc::io
