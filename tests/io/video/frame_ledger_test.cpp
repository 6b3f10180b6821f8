// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/frame_ledger.hpp"

#include <gtest/gtest.h>

namespace geoloc::io {
namespace {

using std::chrono::milliseconds;

constexpr HostTime kStart{std::chrono::seconds{1'790'000'000}};

/// Sends frames of four packets, 50 ms apart.
class Stream {
 public:
  explicit Stream(FrameLedger& ledger, std::uint16_t sequence = 0) : ledger_(ledger), sequence_(sequence) {}

  /// `lost`: which of its packets does not arrive. Returns the frame's timestamp.
  std::uint32_t send(bool is_key_frame, int lost = -1) {
    timestamp_ += 4500;
    now_ += milliseconds{50};
    for (int i = 0; i < 4; ++i) {
      const std::uint16_t sequence = sequence_++;
      if (i != lost) ledger_.observe({sequence, timestamp_, is_key_frame && i == 1}, now_ + milliseconds{i});
    }
    return timestamp_;
  }
  HostTime now() const { return now_; }

 private:
  FrameLedger& ledger_;
  std::uint16_t sequence_;
  std::uint32_t timestamp_ = 0xffff'0000U;
  HostTime now_ = kStart;
};

bool is_damaged(const FrameLedger& ledger, std::uint32_t timestamp) {
  const auto entry = ledger.find(timestamp);
  EXPECT_TRUE(entry);
  return entry && entry->damaged;
}

TEST(FrameLedger, RemembersWhenTheFirstPacketOfAFrameCame) {
  FrameLedger ledger;
  Stream stream{ledger};
  const auto first = stream.send(true);
  const HostTime first_at = stream.now();
  const auto second = stream.send(false);
  ASSERT_TRUE(ledger.find(first));
  EXPECT_EQ(ledger.find(first)->received_at, first_at);
  EXPECT_EQ(ledger.find(second)->received_at, stream.now());
  EXPECT_FALSE(ledger.find(1));
  EXPECT_EQ(ledger.lost_packets(), 0U);
}

TEST(FrameLedger, AStreamJoinedInTheMiddleIsDamagedUntilItsFirstKeyFrame) {
  FrameLedger ledger;
  Stream stream{ledger};
  EXPECT_TRUE(is_damaged(ledger, stream.send(false)));
  EXPECT_FALSE(is_damaged(ledger, stream.send(true)));
  EXPECT_FALSE(is_damaged(ledger, stream.send(false)));
}

TEST(FrameLedger, AGapDamagesItsFrameAndAllUpToTheNextKeyFrame) {
  FrameLedger ledger;
  Stream stream{ledger, 0xfff0};  // the sequence number wraps on the way
  stream.send(true);
  stream.send(false);
  const auto hit = stream.send(false, 2);
  const auto after = stream.send(false);
  const auto key_frame = stream.send(true);
  EXPECT_TRUE(is_damaged(ledger, hit));
  EXPECT_TRUE(is_damaged(ledger, after));
  EXPECT_FALSE(is_damaged(ledger, key_frame));
  EXPECT_EQ(ledger.lost_packets(), 1U);
}

TEST(FrameLedger, AFrameThatLostItsEndIsDamagedThoughItsPacketsWereInOrder) {
  FrameLedger ledger;
  Stream stream{ledger};
  stream.send(true);
  const auto cut = stream.send(false, 3);
  stream.send(true);
  EXPECT_TRUE(is_damaged(ledger, cut));
}

TEST(FrameLedger, AKeyFrameThatLostAPacketIsNoGoodBeginning) {
  FrameLedger ledger;
  Stream stream{ledger};
  stream.send(true);
  const auto key_frame = stream.send(true, 2);
  EXPECT_TRUE(is_damaged(ledger, key_frame));
  EXPECT_TRUE(is_damaged(ledger, stream.send(false)));
}

TEST(FrameLedger, AStreamWithoutKeyFramesHealsInTime) {
  FrameLedger ledger;
  Stream stream{ledger};
  bool damaged = true;
  const HostTime begun = stream.now();
  while (damaged && stream.now() - begun < std::chrono::minutes{1})
    damaged = is_damaged(ledger, stream.send(false));
  EXPECT_FALSE(damaged);
  EXPECT_GE(stream.now() - begun, FrameLedger::kHealsWithin);
}

TEST(FrameLedger, ForgetsFramesLongPast) {
  FrameLedger ledger;
  Stream stream{ledger};
  const auto old = stream.send(true);
  for (int i = 0; i < 1000; ++i) stream.send(false);
  EXPECT_FALSE(ledger.find(old));
}

}  // namespace
}  // namespace geoloc::io
