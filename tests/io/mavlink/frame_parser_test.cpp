// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/frame_parser.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "io/mavlink/test_frames.hpp"

namespace geoloc::io {
namespace {

using testing::Bytes;
using testing::FrameFactory;
using testing::operator+;

constexpr VehicleTime kTime{std::chrono::seconds{100}};

/// The frames found in `stream`, given in pieces of `piece` bytes.
std::vector<Bytes> parse(FrameParser& parser, const Bytes& stream, std::size_t piece = 4096) {
  std::vector<Bytes> found;
  for (std::size_t at = 0; at < stream.size();) {
    at += parser.append(&stream[at], std::min(piece, stream.size() - at));
    while (const auto frame = parser.next()) found.emplace_back(frame->bytes, frame->bytes + frame->size);
  }
  return found;
}

std::vector<Bytes> many_frames(int count) {
  FrameFactory v2({1, 1}), v1({2, 1}, false);
  std::vector<Bytes> frames;
  for (int i = 0; i < count; ++i) {
    FrameFactory& sender = i % 3 == 0 ? v1 : v2;
    const VehicleTime time = kTime + std::chrono::milliseconds{i};
    frames.push_back(i % 2 == 0 ? sender.attitude(time, 0.01 * i) : sender.position(time, 1e-3 * i, 2.0));
  }
  return frames;
}

Bytes joined(const std::vector<Bytes>& frames) {
  Bytes stream;
  for (const Bytes& frame : frames) stream = std::move(stream) + frame;
  return stream;
}

class PiecesOf : public ::testing::TestWithParam<std::size_t> {};

TEST_P(PiecesOf, AStreamGiveTheSameFrames) {
  const auto sent = many_frames(300);
  FrameParser parser;
  EXPECT_EQ(parse(parser, joined(sent), GetParam()), sent);
  EXPECT_EQ(parser.counts().frames, sent.size());
  EXPECT_EQ(parser.counts().junk_bytes, 0U);
  EXPECT_EQ(parser.counts().bad_frames, 0U);
  EXPECT_EQ(parser.sequences().lost(), 0U);
}

INSTANTIATE_TEST_SUITE_P(FrameParser, PiecesOf, ::testing::Values(1, 2, 7, 64, 1000, 100000));

TEST(FrameParser, TellsWhatIsInAFrame) {
  FrameParser parser;
  const Bytes frame = FrameFactory({7, 9}).attitude(kTime, 0.5);
  parser.append(frame.data(), frame.size());
  const auto found = parser.next();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->message_id, 30U);
  EXPECT_EQ(found->sender, (MavAddress{7, 9}));
  EXPECT_TRUE(found->is_v2);
  EXPECT_FALSE(found->is_signed);
  EXPECT_EQ(found->payload_size, frame.size() - 12);
  EXPECT_FALSE(parser.next());
}

TEST(FrameParser, FindsEveryFrameBehindJunk) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> byte(0, 255), length(1, 40);
  const auto sent = many_frames(3000);
  Bytes stream;
  for (const Bytes& frame : sent) {
    for (int left = length(random); left > 0; --left) {
      stream.push_back(static_cast<std::uint8_t>(byte(random)));
    }
    stream = std::move(stream) + frame;
  }
  FrameParser parser;
  EXPECT_EQ(parse(parser, stream), sent);
}

TEST(FrameParser, FindsTheFramesThatADamagedHeaderClaims) {
  const auto sent = many_frames(20);
  Bytes liar_v2 = FrameFactory({1, 1}).attitude(kTime, 1.0, 1.0, 1.0);
  liar_v2[1] = 255;
  Bytes liar_unknown = liar_v2;
  liar_unknown[7] = 0xEE;
  liar_unknown[8] = 0xEE;
  for (const Bytes& liar : {liar_v2, liar_unknown}) {
    FrameParser parser;
    EXPECT_EQ(parse(parser, liar + joined(sent)), sent);
    EXPECT_EQ(parser.counts().junk_bytes, liar.size());
    EXPECT_EQ(parser.counts().unknown_frames, 0U);
  }
}

TEST(FrameParser, FindsFramesBehindOneThatWasCutShort) {
  Bytes whole = FrameFactory({1, 1}).attitude(kTime, 1.0);
  const auto sent = many_frames(20);
  for (std::size_t kept = 1; kept < whole.size(); ++kept) {
    FrameParser parser;
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(kept));
    EXPECT_EQ(parse(parser, cut + joined(sent)), sent) << kept;
  }
}

TEST(FrameParser, RefusesAFrameWithAnyBitChanged) {
  for (const bool is_v2 : {false, true}) {
    const Bytes good = FrameFactory({1, 1}, is_v2).attitude(kTime, 0.3, 0.2, 0.1);
    for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
      Bytes bad = good;
      bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ (1U << bit % 8));
      FrameParser parser;
      EXPECT_TRUE(parse(parser, bad + Bytes(300, 0)).empty()) << bit;
    }
  }
}

TEST(FrameParser, CountsABadFrameOnce) {
  Bytes bad = FrameFactory({1, 1}).attitude(kTime, 0.3);
  bad.back() ^= 0xFF;
  FrameParser parser;
  EXPECT_EQ(parse(parser, bad + FrameFactory({1, 1}).heartbeat()).size(), 1U);
  EXPECT_EQ(parser.counts().bad_frames, 1U);
  EXPECT_EQ(parser.counts().junk_bytes, bad.size());
}

TEST(FrameParser, PassesUnknownMessagesWhole) {
  FrameFactory vehicle({1, 1});
  Bytes stream = vehicle.attitude(kTime);
  for (int i = 0; i < 10; ++i) {
    stream = std::move(stream) + vehicle.unknown(200, 0xFE);
    stream = std::move(stream) + vehicle.attitude(kTime);
  }
  FrameParser parser;
  EXPECT_EQ(parse(parser, stream).size(), 11U);
  EXPECT_EQ(parser.counts().unknown_frames, 10U);
  EXPECT_EQ(parser.counts().bad_frames, 0U);
  EXPECT_EQ(parser.counts().junk_bytes, 0U);
  EXPECT_EQ(parser.sequences().lost(), 0U) << "they fill their places in the sequence";
}

TEST(FrameParser, DoesNotKeepAGoodFrameWaitingBehindAnUnknownOne) {
  FrameFactory vehicle({1, 1});
  FrameParser parser;
  EXPECT_EQ(parse(parser, vehicle.unknown(50, 1) + vehicle.heartbeat()).size(), 1U);
}

TEST(FrameParser, RefusesFlagsThatItDoesNotUnderstand) {
  Bytes frame = FrameFactory({1, 1}).heartbeat();
  frame[2] = 0x02;
  FrameParser parser;
  EXPECT_TRUE(parse(parser, frame).empty());
  EXPECT_EQ(parser.counts().junk_bytes, frame.size());
}

TEST(FrameParser, HardlyBelievesNoise) {
  std::mt19937_64 random(7);
  FrameParser parser;
  Bytes noise(4096);
  std::size_t found = 0;
  for (int i = 0; i < 4000; ++i) {  // 16 MB: 0.004 expected, and the seed is fixed
    std::generate(noise.begin(), noise.end(), [&] { return static_cast<std::uint8_t>(random()); });
    found += parse(parser, noise).size();
  }
  EXPECT_EQ(found, 0U);
}

TEST(FrameParser, EndsOnAnyBytesOfItsOwnAlphabet) {
  // Only bytes that start frames or announce long ones: the most work that a stream can cause.
  std::mt19937 random(3);
  const std::uint8_t alphabet[] = {0xFD, 0xFE, 0xFF, 0, 1, 9, 28, 30, 33};
  FrameParser parser;
  Bytes stream(200'000);
  for (auto& byte : stream) byte = alphabet[random() % std::size(alphabet)];
  parse(parser, stream);
  const FrameCounts& counts = parser.counts();
  EXPECT_LE(counts.junk_bytes, stream.size());
  EXPECT_GT(counts.junk_bytes, 0U);
}

TEST(SequenceTracker, CountsGapsOfEachSenderAcrossTheWrap) {
  SequenceTracker tracker;
  for (int i = 0; i < 600; ++i) {
    if (i % 100 == 50) continue;  // six lost
    tracker.observe({1, 1}, static_cast<std::uint8_t>(i));
    tracker.observe({1, 2}, static_cast<std::uint8_t>(7 + i));
  }
  EXPECT_EQ(tracker.lost({1, 1}), 6U);
  EXPECT_EQ(tracker.lost({1, 2}), 6U);
  EXPECT_EQ(tracker.lost({9, 9}), 0U);
  EXPECT_EQ(tracker.lost(), 12U);
}

TEST(SequenceTracker, DoesNotTakeRepeatedOrOvertakenFramesForLosses) {
  SequenceTracker tracker;
  for (const int sequence : {10, 11, 11, 13, 12, 14})
    tracker.observe({1, 1}, static_cast<std::uint8_t>(sequence));
  EXPECT_LE(tracker.lost(), 2U);
}

TEST(SequenceTracker, SurvivesMoreSendersThanItTracks) {
  SequenceTracker tracker;
  tracker.observe({1, 1}, 0);
  for (int i = 0; i < 65536; ++i) {
    tracker.observe({static_cast<std::uint8_t>(i >> 8), static_cast<std::uint8_t>(i)}, 0);
  }
  tracker.observe({1, 1}, 3);
  EXPECT_EQ(tracker.lost({1, 1}), 2U);
}

}  // namespace
}  // namespace geoloc::io
