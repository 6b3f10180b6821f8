// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/signing.hpp"

#include <gtest/gtest.h>

#include "geoloc/io/mavlink/commands.hpp"
#include "geoloc/io/mavlink/frame_parser.hpp"
#include "io/mavlink/test_frames.hpp"
#include "support/allocation_counter.hpp"

namespace geoloc::io {
namespace {

using testing::Bytes;
using testing::FrameFactory;
using Verdict = LinkSigning::Verdict;

constexpr std::uint64_t kMinute = 6'000'000, kStamp = 37'000'000'000'000;
constexpr HostTime kNow{std::chrono::seconds{1'795'300'000}};

SigningKey key_of(std::uint8_t first) {
  SigningKey key;
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::uint8_t>(first + 7 * i);
  return key;
}

FrameFactory signing_sender(MavAddress sender, std::uint64_t stamp, std::uint8_t link = 3) {
  FrameFactory frames(sender);
  frames.sign({key_of(1), link, stamp});
  return frames;
}

Verdict verdict(LinkSigning& signing, const Bytes& bytes) {
  FrameParser parser;
  parser.append(bytes.data(), bytes.size());
  const auto frame = parser.next();
  EXPECT_TRUE(frame);
  const Verdict verdict = frame ? signing.check(*frame) : Verdict::kUnsigned;
  if (verdict == Verdict::kValid) signing.note(*frame);
  return verdict;
}

Bytes bytes_of(const OutgoingFrame& frame) {
  return Bytes(frame.bytes.begin(), frame.bytes.begin() + frame.size);
}

TEST(SigningKey, IsThirtyTwoBytesOrTheirDigits) {
  const SigningKey key = key_of(1);
  std::string raw(key.begin(), key.end()), digits;
  for (const std::uint8_t byte : key) {
    digits += "0123456789abcdef"[byte >> 4];
    digits += "0123456789ABCDEF"[byte & 15];
  }
  EXPECT_EQ(parse_signing_key(raw), key);
  EXPECT_EQ(parse_signing_key(digits), key);
  EXPECT_EQ(parse_signing_key(" " + digits + "\r\n"), key);
  std::string other = digits;
  other[10] = 'g';
  for (const std::string& wrong :
       {std::string(), std::string(" \n"), raw + "x", raw.substr(1), digits.substr(1), digits + "0", other,
        digits + " " + digits, std::string(64, '-')})
    EXPECT_FALSE(parse_signing_key(wrong)) << wrong;
}

TEST(SigningStamps, AreReadBackAndNothingElseIs) {
  for (const SigningStamps& stamps :
       {SigningStamps{}, SigningStamps{kStamp, 12}, SigningStamps{7, (1ULL << 48) - 1}})
    EXPECT_EQ(parse_signing_stamps(to_text(stamps)), stamps);
  for (const char* const wrong :
       {"", "sent 1\n", "sent 1\nheard 2", "sent 1\nheard 2\n\n", "sent -1\nheard 2\n", "heard 2\nsent 1\n",
        "sent \nheard 2\n", "sent 281474976710656\nheard 2\n", "sent 99999999999999999999\nheard 2\n",
        "sent 1 \nheard 2\n", "sent 0x1\nheard 2\n"})
    EXPECT_FALSE(parse_signing_stamps(wrong)) << wrong;
  EXPECT_FALSE(parse_signing_stamps(std::string("sent 1\nheard 2\n\0", 16)));
}

TEST(LinkSigning, BelievesWhatIsSignedByItsKeyOnce) {
  LinkSigning signing(key_of(1), {});
  FrameFactory vehicle = signing_sender({1, 1}, kStamp);
  const Bytes frame = vehicle.attitude(VehicleTime{});
  EXPECT_EQ(verdict(signing, frame), Verdict::kValid);
  EXPECT_EQ(signing.stamps().heard, kStamp);
  EXPECT_EQ(verdict(signing, frame), Verdict::kRepeated);
  EXPECT_EQ(verdict(signing, vehicle.attitude(VehicleTime{})), Verdict::kValid);
  EXPECT_EQ(verdict(signing, FrameFactory({1, 1}).attitude(VehicleTime{})), Verdict::kUnsigned);
  EXPECT_EQ(verdict(signing, FrameFactory({1, 1}, false).attitude(VehicleTime{})), Verdict::kUnsigned);
  LinkSigning other(key_of(2), {});
  EXPECT_EQ(verdict(other, vehicle.attitude(VehicleTime{})), Verdict::kWrong);
  EXPECT_EQ(other.stamps(), SigningStamps{});
}

TEST(LinkSigning, SeesEveryChangedBit) {
  const Bytes good = signing_sender({1, 1}, kStamp).heartbeat();
  for (std::size_t i = 1; i < good.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      Bytes changed = good;
      changed[i] = static_cast<std::uint8_t>(changed[i] ^ 1U << bit);
      FrameParser parser;
      parser.append(changed.data(), changed.size());
      LinkSigning signing(key_of(1), {});
      const auto frame = parser.next();
      EXPECT_TRUE(!frame || signing.check(*frame) != Verdict::kValid) << i << " " << bit;
    }
  }
}

TEST(LinkSigning, RemembersEachLinkOfEachComponent) {
  LinkSigning signing(key_of(1), {});
  EXPECT_EQ(verdict(signing, signing_sender({1, 1}, kStamp).heartbeat()), Verdict::kValid);
  EXPECT_EQ(verdict(signing, signing_sender({1, 1}, kStamp - 5).heartbeat()), Verdict::kRepeated);
  EXPECT_EQ(verdict(signing, signing_sender({1, 1}, kStamp - 5, 4).heartbeat()), Verdict::kValid);
  EXPECT_EQ(verdict(signing, signing_sender({1, 2}, kStamp - kMinute).heartbeat()), Verdict::kValid);
  EXPECT_EQ(verdict(signing, signing_sender({1, 3}, kStamp - kMinute - 1).heartbeat()), Verdict::kRepeated);
}

TEST(LinkSigning, RefusesOverARestartWhatIsOverAMinuteOld) {
  LinkSigning before(key_of(1), {});
  FrameFactory vehicle = signing_sender({1, 1}, kStamp);
  const Bytes old = vehicle.heartbeat();
  vehicle.sign({key_of(1), 3, kStamp + kMinute + 1});
  EXPECT_EQ(verdict(before, old), Verdict::kValid);
  EXPECT_EQ(verdict(before, vehicle.heartbeat()), Verdict::kValid);
  LinkSigning after(key_of(1), *parse_signing_stamps(to_text(before.stamps())));
  EXPECT_EQ(verdict(after, old), Verdict::kRepeated);
  EXPECT_EQ(verdict(after, vehicle.heartbeat()), Verdict::kValid);
}

TEST(LinkSigning, DoesNotRememberMoreSendersThanItHasRoomFor) {
  LinkSigning signing(key_of(1), {});
  int valid = 0;
  for (int system = 1; system <= 255; ++system) {
    FrameFactory sender = signing_sender({static_cast<std::uint8_t>(system), 1}, kStamp);
    valid += verdict(signing, sender.heartbeat()) == Verdict::kValid ? 1 : 0;
  }
  EXPECT_EQ(valid, 64);
}

TEST(LinkSigning, SignsAsTheGeneratedCodeChecks) {
  LinkSigning signing(key_of(1), {});
  CommandWriter writer;
  const MavAddress self{1, 191};
  std::uint64_t last = 0;
  for (const OutgoingFrame& frame : {writer.heartbeat(self), writer.timesync_request(self, 1'234'567'000'191),
                                     writer.status_text(self, std::string(50, 'x')),
                                     writer.set_message_interval(self, {1, 1}, 30, 10.0)}) {
    const Bytes sent = bytes_of(signing.sign(frame, kNow));
    EXPECT_EQ(sent.size(), frame.size + 13);
    EXPECT_TRUE(testing::is_signed_by(key_of(1), sent));
    EXPECT_FALSE(testing::is_signed_by(key_of(2), sent));
    EXPECT_GT(signing.stamps().sent, last) << "though no time has passed";
    last = signing.stamps().sent;
  }
  EXPECT_NEAR(static_cast<double>(last), (1'795'300'000.0 - 1'420'070'400.0) * 1e5, 10.0);
}

TEST(LinkSigning, StampsOnlyGrow) {
  LinkSigning signing(key_of(1), {});
  CommandWriter writer;
  EXPECT_EQ(verdict(signing, signing_sender({1, 1}, kStamp + 1'000'000'000'000).heartbeat()),
            Verdict::kValid);
  signing.sign(writer.heartbeat({1, 191}), kNow);
  EXPECT_EQ(signing.stamps().sent, kStamp + 1'000'000'000'001) << "the vehicle's clock is ahead";
  LinkSigning restarted(key_of(1), signing.stamps());
  restarted.sign(writer.heartbeat({1, 191}), HostTime{});
  EXPECT_GT(restarted.stamps().sent, signing.stamps().sent) << "the computer's clock is not set yet";
}

TEST(LinkSigning, LeavesFramesThatHaveNoRoomForASignature) {
  LinkSigning signing(key_of(1), {});
  CommandWriter writer;
  writer.use_v2(false);
  const OutgoingFrame old = writer.heartbeat({1, 191});
  EXPECT_EQ(bytes_of(signing.sign(old, kNow)), bytes_of(old));
  writer.use_v2(true);
  const OutgoingFrame once = signing.sign(writer.heartbeat({1, 191}), kNow);
  EXPECT_EQ(bytes_of(signing.sign(once, kNow)), bytes_of(once));
}

TEST(LinkSigning, DoesNotAllocate) {
  LinkSigning signing(key_of(1), {});
  CommandWriter writer;
  const Bytes bytes = signing_sender({1, 1}, kStamp).heartbeat();
  FrameParser parser;
  parser.append(bytes.data(), bytes.size());
  const auto frame = parser.next();
  const std::size_t before = geoloc::testing::allocations();
  EXPECT_EQ(signing.check(*frame), Verdict::kValid);
  signing.note(*frame);
  signing.sign(writer.heartbeat({1, 191}), kNow);
  EXPECT_EQ(geoloc::testing::allocations(), before);
}

}  // namespace
}  // namespace geoloc::io
