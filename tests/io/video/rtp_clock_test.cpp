// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/rtp_clock.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <random>

namespace geoloc::io {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr double kTicksPerSecond = 90'000;
constexpr HostTime kStart{std::chrono::seconds{1'790'000'000}};

/// A sender whose wall clock is off by `clock_offset` and whose RTP clock runs fast by `drift` (1e-6 is 1
/// ppm).
struct Sender {
  Duration clock_offset{0};
  double drift = 0.0;
  std::uint32_t first_timestamp = 0;

  std::uint32_t timestamp(HostTime at) const {
    const double ticks = seconds(at - kStart) * kTicksPerSecond * (1 + drift);
    return first_timestamp + static_cast<std::uint32_t>(static_cast<std::int64_t>(ticks));
  }
  SenderReport report(HostTime at, Duration error = Duration{0}) const {
    return {timestamp(at), static_cast<std::uint32_t>(kTicksPerSecond),
            SenderTime{at.time_since_epoch() + clock_offset + error}};
  }
};

double error_s(const RtpClock::Capture& capture, HostTime truth) {
  return seconds(capture.captured_at - truth);
}

TEST(RtpClock, WithoutReportsAFrameIsAsOldAsTheConfiguredLatency) {
  RtpClock clock{milliseconds{80}};
  const auto capture = clock.capture_time(12345, kStart);
  EXPECT_EQ(capture.quality, TimeQuality::kArrival);
  EXPECT_EQ(capture.captured_at, kStart - milliseconds{80});
}

TEST(RtpClock, OneReportIsUsedButNotTrusted) {
  const Sender sender;
  RtpClock clock{milliseconds{80}};
  clock.observe(sender.report(kStart));
  clock.observe(sender.report(kStart));  // the same one again confirms nothing
  const HostTime truth = kStart + milliseconds{500};
  const auto capture = clock.capture_time(sender.timestamp(truth), truth + milliseconds{30});
  EXPECT_EQ(capture.quality, TimeQuality::kUnconfirmed);
  EXPECT_NEAR(error_s(capture, truth), 0.0, 1e-4);
}

TEST(RtpClock, TwoReportsThatAgreeGiveTheSendersTime) {
  const Sender sender;
  RtpClock clock{milliseconds{80}};
  clock.observe(sender.report(kStart, milliseconds{-58}));  // from a server that was still starting
  clock.observe(sender.report(kStart + milliseconds{200}));
  EXPECT_EQ(clock.capture_time(sender.timestamp(kStart), kStart + milliseconds{300}).quality,
            TimeQuality::kUnconfirmed);
  clock.observe(sender.report(kStart + milliseconds{400}));
  const HostTime truth = kStart + milliseconds{500};
  const auto capture = clock.capture_time(sender.timestamp(truth), truth + milliseconds{30});
  EXPECT_EQ(capture.quality, TimeQuality::kRecovered);
  EXPECT_NEAR(error_s(capture, truth), 0.0, 1e-4);
}

TEST(RtpClock, OneBadReportDoesNotShiftATrustedClock) {
  const Sender sender;
  RtpClock clock{Duration{0}};
  for (int i = 0; i < 3; ++i) clock.observe(sender.report(kStart + i * milliseconds{500}));
  clock.observe(sender.report(kStart + milliseconds{2000}, milliseconds{400}));
  const HostTime truth = kStart + milliseconds{2100};
  const auto capture = clock.capture_time(sender.timestamp(truth), truth + milliseconds{500});
  EXPECT_EQ(capture.quality, TimeQuality::kRecovered);
  EXPECT_NEAR(error_s(capture, truth), 0.0, 1e-4);
}

TEST(RtpClock, FollowsASenderWhoseClockWasSet) {
  Sender sender;
  RtpClock clock{Duration{0}};
  for (int i = 0; i < 3; ++i) clock.observe(sender.report(kStart + i * milliseconds{500}));
  sender.clock_offset = milliseconds{-700};
  for (int i = 3; i < 5; ++i) clock.observe(sender.report(kStart + i * milliseconds{500}));
  const HostTime truth = kStart + milliseconds{2600};
  const auto capture = clock.capture_time(sender.timestamp(truth), truth + milliseconds{30});
  EXPECT_EQ(capture.quality, TimeQuality::kRecovered);
  EXPECT_NEAR(error_s(capture, truth), -0.7, 1e-4);
}

TEST(RtpClock, SurvivesTheWrapOfTheTimestamp) {
  Sender sender;
  sender.first_timestamp = 0xffff'ffffU - 90'000;  // wraps after a second
  RtpClock clock{Duration{0}};
  for (int i = 0; i < 40; ++i) {
    const HostTime truth = kStart + i * milliseconds{100};
    if (i % 5 == 0) clock.observe(sender.report(truth));
    const auto capture = clock.capture_time(sender.timestamp(truth), truth + milliseconds{20});
    EXPECT_NEAR(error_s(capture, truth), 0.0, 1e-4) << i;
  }
}

TEST(RtpClock, FollowsACrystalThatRunsFast) {
  Sender sender;
  sender.drift = 150e-6;
  RtpClock clock{Duration{0}};
  for (int i = 0; i < 720; ++i) {  // an hour of reports: the clocks part by half a second
    const HostTime reported_at = kStart + i * std::chrono::seconds{5};
    clock.observe(sender.report(reported_at));
    const HostTime truth = reported_at + std::chrono::seconds{4};
    const auto capture = clock.capture_time(sender.timestamp(truth), truth + milliseconds{20});
    EXPECT_NEAR(error_s(capture, truth), 0.0, 0.001);
    EXPECT_EQ(capture.quality, i == 0 ? TimeQuality::kUnconfirmed : TimeQuality::kRecovered);
  }
}

struct ForeignClock {
  const char* name;
  Duration offset;
};

class ForeignClocks : public ::testing::TestWithParam<ForeignClock> {};

TEST_P(ForeignClocks, AreToldAndMappedThroughTheFastestFrame) {
  Sender sender;
  sender.clock_offset = GetParam().offset;
  RtpClock clock{milliseconds{40}};
  clock.observe(sender.report(kStart));
  clock.observe(sender.report(kStart + milliseconds{400}));
  std::mt19937 random{1};
  std::exponential_distribution<double> jitter_s{1 / 0.02};
  RtpClock::Capture capture;
  for (int i = 0; i < 300; ++i) {
    const HostTime truth = kStart + i * milliseconds{50};
    capture = clock.capture_time(sender.timestamp(truth),
                                 truth + milliseconds{40} + from_seconds(jitter_s(random)));
    ASSERT_EQ(capture.quality, TimeQuality::kForeignClock);
    if (i < 100) continue;
    EXPECT_NEAR(error_s(capture, truth), 0.0, 0.002) << "the constant latency is configured";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Offsets, ForeignClocks,
    ::testing::Values(ForeignClock{"SinceItsBoot", std::chrono::minutes{7} - kStart.time_since_epoch()},
                      ForeignClock{"ASecondAhead", milliseconds{1000}}, ForeignClock{"AnHourAhead", hours{1}},
                      ForeignClock{"SlowBy10s", milliseconds{-10'000}}),
    [](const auto& instance) { return std::string{instance.param.name}; });

TEST(RtpClock, OneLateFrameDoesNotMakeAClockForeign) {
  const Sender sender;
  RtpClock clock{Duration{0}};
  clock.observe(sender.report(kStart));
  clock.observe(sender.report(kStart + milliseconds{400}));
  EXPECT_EQ(clock.capture_time(sender.timestamp(kStart), kStart + milliseconds{30}).quality,
            TimeQuality::kRecovered);
  EXPECT_EQ(clock.capture_time(sender.timestamp(kStart), kStart + milliseconds{8000}).quality,
            TimeQuality::kRecovered);
}

TEST(RtpClock, AReportTooOldIsNotUsed) {
  const Sender sender;
  RtpClock clock{Duration{0}};
  clock.observe(sender.report(kStart));
  clock.observe(sender.report(kStart + milliseconds{400}));
  const HostTime late = kStart + RtpClock::kReportLifetime + std::chrono::seconds{1};
  EXPECT_EQ(clock.capture_time(sender.timestamp(late), late).quality, TimeQuality::kArrival);
}

TEST(RtpClock, TakesAnyNumbers) {
  std::mt19937_64 random{2};
  RtpClock clock{milliseconds{10}};
  for (int i = 0; i < 20'000; ++i) {
    const auto rate = i % 7 == 0 ? 0U : static_cast<std::uint32_t>(random());
    clock.observe({static_cast<std::uint32_t>(random()), rate, from_ntp(random())});
    const HostTime received_at = kStart + microseconds{i};
    const auto capture = clock.capture_time(static_cast<std::uint32_t>(random()), received_at);
    EXPECT_LE(capture.captured_at, received_at);
  }
}

TEST(NtpTime, CountsFrom1900InParts) {
  EXPECT_EQ(from_ntp(std::uint64_t{2'208'988'800} << 32U).time_since_epoch(), Duration{0});
  EXPECT_EQ(from_ntp((std::uint64_t{2'208'988'801} << 32U) + 0x8000'0000U).time_since_epoch(),
            milliseconds{1500});
}

}  // namespace
}  // namespace geoloc::io
