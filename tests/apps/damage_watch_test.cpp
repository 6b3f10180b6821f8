// SPDX-License-Identifier: Apache-2.0
#include "app/damage_watch.hpp"

#include <gtest/gtest.h>

namespace geoloc::apps {
namespace {

/// A stream of 20 frames and 100 packets a second, observed every second.
class Watched {
 public:
  explicit Watched(io::RtspTransport transport) : watch_(transport) {}

  std::string second(std::uint64_t damaged, std::uint64_t lost) {
    now_ += std::chrono::seconds{1};
    video_.frames += 20;
    video_.damaged += damaged;
    video_.packets += 100 - lost;
    video_.lost_packets += lost;
    return watch_.observe(now_, video_);
  }

 private:
  DamageWatch watch_;
  HostTime now_{std::chrono::seconds{1'800'000'000}};
  io::VideoStatus video_;
};

TEST(DamageWatch, SaysNothingOfAGoodStream) {
  Watched stream(io::RtspTransport::kUdp);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(stream.second(0, 0), "");
}

TEST(DamageWatch, SaysNothingWhileAStreamThatWasJoinedWaitsForAWholePicture) {
  Watched stream(io::RtspTransport::kTcp);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(stream.second(20, 0), "");
}

TEST(DamageWatch, NamesTheSharesAndTheRemedy) {
  Watched stream(io::RtspTransport::kUdp);
  stream.second(0, 0);
  EXPECT_EQ(
      stream.second(15, 3),
      "video: frames come, but 75 % of them are damaged and left out, for 3.0 % of the packets are lost: "
      "set \"video\": {\"transport\": \"tcp\"} in --config, which loses none");
  Watched over_tcp(io::RtspTransport::kTcp);
  over_tcp.second(0, 0);
  EXPECT_NE(over_tcp.second(15, 3).find("bit rate"), std::string::npos);
}

TEST(DamageWatch, KeepsItsTextWhileItLastsAndEndsWithTheLoss) {
  Watched stream(io::RtspTransport::kUdp);
  stream.second(0, 0);
  const std::string first = stream.second(15, 3);
  for (std::uint64_t i = 0; i < 20; ++i) EXPECT_EQ(stream.second(10 + i % 3, i % 5), first);
  std::string last = first;
  for (int i = 0; i < 12; ++i) last = stream.second(0, 0);
  EXPECT_EQ(last, "");
}

TEST(DamageWatch, ToleratesALittle) {
  Watched stream(io::RtspTransport::kUdp);
  for (int i = 0; i < 30; ++i) EXPECT_EQ(stream.second(1, 1), "");
}

}  // namespace
}  // namespace geoloc::apps
