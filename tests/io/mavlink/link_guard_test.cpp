// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/link_guard.hpp"

#include <gtest/gtest.h>

#include <random>

#include "geoloc/io/mavlink/commands.hpp"
#include "geoloc/io/mavlink/vehicle_link.hpp"
#include "io/mavlink/collecting_sink.hpp"
#include "io/mavlink/test_frames.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;
using testing::Bytes;
using testing::FrameFactory;

constexpr HostTime kGuardBegins{std::chrono::seconds{1'795'300'000}};

LinkSource source(std::uint16_t port) {
  LinkSource source;
  source.address = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 127, 0, 0, 1};
  source.port = port;
  return source;
}

/// A guard, and the frames that it let through.
class LinkGuardTest : public ::testing::Test {
 protected:
  bool passes(const Bytes& bytes, std::uint16_t port, Duration after_start) {
    const std::size_t before = passed_.size();
    guard_.receive(
        kGuardBegins + after_start, source(port), bytes.data(), bytes.size(),
        [this](const std::uint8_t* frame, std::size_t size) { passed_.emplace_back(frame, frame + size); });
    return passed_.size() > before;
  }

  static VehicleTime at(Duration since_boot) { return VehicleTime{since_boot}; }

  LinkGuard guard_{MavlinkConfig{}};
  std::vector<Bytes> passed_;
  FrameFactory vehicle_{{1, 1}};
  FrameFactory forger_{{1, 1}};
};

TEST_F(LinkGuardTest, NamesSources) {
  EXPECT_EQ(to_string(source(14550)), "127.0.0.1:14550");
  LinkSource six;
  six.address[15] = 1;
  six.port = 5;
  EXPECT_EQ(to_string(six), "[::1]:5");
}

TEST_F(LinkGuardTest, JoinsThePiecesOfEachSource) {
  const Bytes frame = vehicle_.attitude(at(1s)), other = FrameFactory({255, 190}).heartbeat(8, 6);
  const Bytes head(frame.begin(), frame.begin() + 9), tail(frame.begin() + 9, frame.end());
  EXPECT_FALSE(passes(head, 1, 1s));
  EXPECT_TRUE(passes(other, 2, 1s));
  EXPECT_TRUE(passes(tail, 1, 1s));
  EXPECT_EQ(passed_.back(), frame);
}

TEST_F(LinkGuardTest, OneSourceSpeaksForAnAutopilotWhileItSendsState) {
  EXPECT_TRUE(passes(vehicle_.heartbeat(), 1, 0s));
  for (Duration t = 0s; t < 20s; t += 500ms) {
    EXPECT_TRUE(passes(vehicle_.attitude(at(t)), 1, t));
    EXPECT_FALSE(passes(forger_.heartbeat(), 2, t));
    EXPECT_FALSE(passes(forger_.position(at(t), 1.0, 2.0), 2, t));
    EXPECT_FALSE(passes(forger_.timesync(0, 5), 2, t));
    EXPECT_TRUE(passes(FrameFactory({1, 154}).heartbeat(8, 26), 2, t)) << "a gimbal may speak from elsewhere";
    EXPECT_TRUE(passes(FrameFactory({2, 1}).heartbeat(), 2, t)) << "and another vehicle";
  }
  EXPECT_EQ(guard_.counts().second_source, 120U);
  ASSERT_TRUE(guard_.last_second_source());
  EXPECT_EQ(guard_.last_second_source()->system, 1);
  EXPECT_EQ(guard_.last_second_source()->refused, source(2));
  EXPECT_EQ(guard_.last_second_source()->speaks, source(1));
}

TEST_F(LinkGuardTest, AnotherSourceThatSendsStateFollowsOneThatWentSilent) {
  EXPECT_TRUE(passes(vehicle_.attitude(at(0s)), 1, 0s));
  EXPECT_FALSE(passes(vehicle_.attitude(at(2s)), 2, 2900ms));
  EXPECT_TRUE(passes(vehicle_.attitude(at(3s)), 2, 3100ms));
  EXPECT_FALSE(passes(vehicle_.attitude(at(4s)), 1, 4s));
}

TEST_F(LinkGuardTest, HeartbeatsAloneKeepNoVehicleOut) {
  EXPECT_TRUE(passes(forger_.heartbeat(), 2, 0s));
  EXPECT_FALSE(passes(vehicle_.heartbeat(), 1, 1s));
  EXPECT_TRUE(passes(vehicle_.attitude(at(1s)), 1, 1100ms)) << "state is what counts";
  EXPECT_FALSE(passes(forger_.heartbeat(), 2, 2s));
}

TEST_F(LinkGuardTest, SourcesThatSendNoStateUnaskedHaveTheirTurns) {
  int turns = 0;
  bool was_vehicles = false;
  for (Duration t = 0s; t < 30s; t += 1s) {
    passes(forger_.heartbeat(), 2, t);
    const bool is_vehicles = passes(vehicle_.heartbeat(), 1, t + 500ms);
    turns += is_vehicles && !was_vehicles ? 1 : 0;
    was_vehicles = is_vehicles;
  }
  EXPECT_EQ(turns, 3);
}

TEST_F(LinkGuardTest, TakesEachSystemsFirstAnswerToARequestThatWasMade) {
  CommandWriter writer;
  constexpr std::int64_t kAsked = 1'795'300'001'000'000'191;
  const OutgoingFrame request = writer.timesync_request({1, 191}, kAsked);
  const OutgoingFrame sent = guard_.outgoing(kGuardBegins, request.bytes.data(), request.size);
  EXPECT_TRUE(std::equal(request.bytes.begin(), request.bytes.begin() + request.size, sent.bytes.begin()));
  EXPECT_FALSE(passes(vehicle_.timesync(1'000'000'000, kAsked + 1000), 1, 1s)) << "of a request never made";
  FrameFactory other({9, 1});
  EXPECT_TRUE(passes(other.timesync(7'000'000'000, kAsked), 3, 1s));
  EXPECT_TRUE(passes(vehicle_.timesync(1'000'000'000, kAsked), 1, 1s));
  EXPECT_FALSE(passes(vehicle_.timesync(1'000'000'000, kAsked), 1, 1s));
  EXPECT_EQ(guard_.counts().unasked_timesyncs, 2U);
  EXPECT_TRUE(passes(vehicle_.timesync(0, kAsked), 1, 1s)) << "a request of the vehicle's";
  EXPECT_TRUE(passes(vehicle_.timesync(1, kAsked + 1), 1, 1s)) << "an answer to another program";
}

TEST_F(LinkGuardTest, WithAKeyOnlyWhatIsSignedPassesAndWhatIsSentIsSigned) {
  SigningKey key{};
  key[5] = 77;
  guard_ = LinkGuard(MavlinkConfig{}, LinkSigning(key, {}));
  EXPECT_FALSE(passes(vehicle_.heartbeat(), 1, 0s));
  SigningKey wrong{};
  vehicle_.sign({wrong, 0, 1000});
  EXPECT_FALSE(passes(vehicle_.heartbeat(), 1, 0s));
  vehicle_.sign({key, 0, 1000});
  const Bytes good = vehicle_.attitude(at(1s));
  EXPECT_TRUE(passes(good, 1, 1s));
  EXPECT_FALSE(passes(good, 1, 1s));
  EXPECT_FALSE(passes(good, 2, 1s));
  EXPECT_EQ(guard_.counts().unsigned_frames, 1U);
  EXPECT_EQ(guard_.counts().wrong_signatures, 1U);
  EXPECT_EQ(guard_.counts().repeated_signatures, 2U);
  EXPECT_EQ(guard_.counts().second_source, 0U) << "what is not signed says nothing of its system's sources";
  EXPECT_EQ(guard_.signing_stamps()->heard, 1000U);
  EXPECT_EQ(guard_.last_refused_signature(), kGuardBegins + 1s);

  const OutgoingFrame request = CommandWriter().timesync_request({1, 191}, 191);
  const OutgoingFrame sent = guard_.outgoing(kGuardBegins, request.bytes.data(), request.size);
  EXPECT_TRUE(testing::is_signed_by(key, Bytes(sent.bytes.begin(), sent.bytes.begin() + sent.size)));
}

TEST_F(LinkGuardTest, ACopyFromElsewhereThatComesFirstKeepsNoSignedFrameOut) {
  const SigningKey key{};
  guard_ = LinkGuard(MavlinkConfig{}, LinkSigning(key, {}));
  vehicle_.sign({key, 0, 1000});
  EXPECT_TRUE(passes(vehicle_.attitude(at(0s)), 1, 0s));
  const Bytes next = vehicle_.attitude(at(1s));
  EXPECT_FALSE(passes(next, 2, 1s));
  EXPECT_TRUE(passes(next, 1, 1s));
}

TEST_F(LinkGuardTest, AFloodOfSourcesKeepsNoWholeFrameOut) {
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    passes(Bytes{0xFD, 40, 0, 0, 1, 1, 1}, static_cast<std::uint16_t>(1000 + i), i * 1ms);
    if (i % 100 == 0) {
      EXPECT_TRUE(passes(vehicle_.attitude(at(i * 1ms)), 1, i * 1ms));
    }
  }
}

/// Two sources of one system in any order, and others: what passes gives a replay the samples of the live
/// run.
TEST_F(LinkGuardTest, AReplayOfWhatPassedNeedsNoGuard) {
  std::mt19937 random(2);
  FrameFactory other({7, 1});
  testing::CollectingSink live_sink, replayed_sink;
  VehicleLink live{MavlinkConfig{}}, replayed{MavlinkConfig{}};
  for (int i = 0; i < 20'000; ++i) {
    const Duration now = i * 10ms;
    const bool is_forged = random() % 2 == 0;
    FrameFactory& sender = random() % 5 == 0 ? other : is_forged ? forger_ : vehicle_;
    const VehicleTime stamp = at(is_forged ? now + 40s : now);
    const int what = static_cast<int>(random() % (i % 2000 < 500 ? 40 : 4));  // with pauses of the state
    const Bytes frame = what == 0   ? sender.attitude(stamp)
                        : what == 1 ? sender.position(stamp, is_forged ? 48.0 : 47.0, 8.0)
                        : what == 2 ? sender.system_time(stamp)
                                    : sender.heartbeat();
    const std::size_t before = passed_.size();
    passes(frame, is_forged ? 2 : 1, now);
    for (std::size_t k = before; k < passed_.size(); ++k)
      live.consume(kGuardBegins + now, passed_[k].data(), passed_[k].size(), live_sink);
  }
  for (const auto& frame : live_sink.frames)
    replayed.consume(frame.at, frame.bytes.data(), frame.bytes.size(), replayed_sink);
  EXPECT_GT(guard_.counts().second_source, 1000U);
  EXPECT_GT(live_sink.attitudes.size(), 100U);
  ASSERT_EQ(live_sink.attitudes.size(), replayed_sink.attitudes.size());
  for (std::size_t i = 0; i < live_sink.attitudes.size(); ++i)
    EXPECT_EQ(live_sink.attitudes[i].time, replayed_sink.attitudes[i].time);
  EXPECT_EQ(live_sink.positions.size(), replayed_sink.positions.size());
}

}  // namespace
}  // namespace geoloc::io
