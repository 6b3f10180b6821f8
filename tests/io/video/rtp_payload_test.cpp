// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/rtp_payload.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace geoloc::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

bool begins(VideoCodec codec, const Bytes& payload) {
  return begins_random_access_picture(codec, payload.data(), payload.size());
}
bool h264(const Bytes& payload) {
  return begins(VideoCodec::kH264, payload);
}
bool h265(const Bytes& payload) {
  return begins(VideoCodec::kH265, payload);
}

constexpr std::uint8_t kFirstSlice = 0x88;
constexpr std::uint8_t kLaterSlice = 0x48;

TEST(RtpPayload, KnowsTheFirstSliceOfAnIdrPictureOfH264) {
  EXPECT_TRUE(h264({0x65, kFirstSlice}));
  EXPECT_FALSE(h264({0x65, kLaterSlice}));  // the first one may be lost
  EXPECT_FALSE(h264({0x41, kFirstSlice}));  // a slice of any other picture
  EXPECT_FALSE(h264({0x67, kFirstSlice}));  // parameters are no picture
}

TEST(RtpPayload, KnowsItAsAFragment) {
  EXPECT_TRUE(h264({0x7c, 0x85, kFirstSlice}));
  EXPECT_FALSE(h264({0x7c, 0x05, kFirstSlice}));  // a later fragment
  EXPECT_FALSE(h264({0x7c, 0x81, kFirstSlice}));
}

TEST(RtpPayload, KnowsItBehindParametersInOnePacket) {
  EXPECT_TRUE(h264({0x78, 0, 2, 0x67, 0x42, 0, 1, 0x68, 0, 2, 0x65, kFirstSlice}));
  EXPECT_FALSE(h264({0x78, 0, 2, 0x67, 0x42, 0, 1, 0x68}));
}

TEST(RtpPayload, KnowsRandomAccessPicturesOfH265) {
  EXPECT_TRUE(h265({19 << 1, 1, kFirstSlice}));             // IDR
  EXPECT_TRUE(h265({21 << 1, 1, kFirstSlice}));             // CRA
  EXPECT_TRUE(h265({49 << 1, 1, 0x80 | 19, kFirstSlice}));  // fragment
  EXPECT_TRUE(h265({48 << 1, 1, 0, 3, 33 << 1, 1, 0, 0, 3, 20 << 1, 1, kFirstSlice}));
  EXPECT_FALSE(h265({1 << 1, 1, kFirstSlice}));
  EXPECT_FALSE(h265({19 << 1, 1, kLaterSlice}));
}

TEST(RtpPayload, TakesPayloadsCutShortAnywhere) {
  const std::vector<Bytes> whole{{0x65, kFirstSlice},
                                 {0x7c, 0x85, kFirstSlice},
                                 {0x78, 0, 2, 0x65, kFirstSlice},
                                 {48 << 1, 1, 0, 3, 20 << 1, 1, kFirstSlice}};
  for (const Bytes& payload : whole) {
    for (std::size_t size = 0; size < payload.size(); ++size) {
      const Bytes cut(payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_FALSE(h264(cut));
      EXPECT_FALSE(h265(cut));
    }
  }
  EXPECT_FALSE(h264({0x78, 0xff, 0xff, 0x65, kFirstSlice}));  // a unit longer than the packet
}

}  // namespace
}  // namespace geoloc::io
