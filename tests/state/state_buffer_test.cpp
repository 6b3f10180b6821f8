// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/state_buffer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace geoloc {
namespace {

using std::chrono::milliseconds;

VehicleTime at(int ms) {
  return VehicleTime{milliseconds{ms}};
}
constexpr Duration kGap = milliseconds{500};
constexpr Duration kNone = Duration::zero();

TEST(StateBuffer, InterpolatesLinearlyBetweenNeighbours) {
  StateBuffer<double, 8> buffer;
  buffer.insert(at(100), 1.0);
  buffer.insert(at(200), 3.0);
  buffer.insert(at(400), 7.0);
  for (const auto& [ms, expected] : {std::pair{100, 1.0}, {125, 1.5}, {200, 3.0}, {350, 6.0}, {400, 7.0}}) {
    const auto bracket = buffer.bracket(at(ms), kGap, kNone);
    ASSERT_TRUE(bracket) << ms;
    EXPECT_DOUBLE_EQ(bracket->interpolated(), expected) << ms;
  }
}

TEST(StateBuffer, SaysWhyThereIsNoAnswer) {
  StateBuffer<double, 8> buffer;
  EXPECT_EQ(buffer.bracket(at(0), kGap, kNone).error(), NoState::kNoSamples);
  buffer.insert(at(1000), 1.0);
  EXPECT_EQ(buffer.bracket(at(1001), kGap, kNone).error(), NoState::kNotYet);
  buffer.insert(at(1100), 2.0);
  buffer.insert(at(2000), 3.0);
  buffer.insert(at(2100), 3.0);
  EXPECT_EQ(buffer.bracket(at(999), kGap, kNone).error(), NoState::kTooOld);
  EXPECT_EQ(buffer.bracket(at(1500), kGap, kNone).error(), NoState::kInAGap);
  EXPECT_EQ(buffer.bracket(at(2101), kGap, kNone).error(), NoState::kNotYet);
}

/// Pictures that are taken seconds apart may have a sample each, and no other.
TEST(StateBuffer, NeedsNoNeighbourForASampleOfExactlyThatTime) {
  StateBuffer<double, 8> buffer;
  buffer.insert(at(1000), 1.0);
  const auto alone = buffer.bracket(at(1000), kGap, kNone);
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->interpolated(), 1.0);
  EXPECT_EQ(alone->spacing, kNone);
  EXPECT_EQ(alone->sigma(5.0), 0.0);
  buffer.insert(at(9000), 5.0);
  buffer.insert(at(20000), 7.0);
  for (const auto& [ms, expected] : {std::pair{1000, 1.0}, {9000, 5.0}, {20000, 7.0}}) {
    const auto bracket = buffer.bracket(at(ms), kGap, kNone);
    ASSERT_TRUE(bracket) << ms;
    EXPECT_DOUBLE_EQ(bracket->interpolated(), expected);
    EXPECT_EQ(bracket->sigma(5.0), 0.0);
    EXPECT_GT(bracket->spacing, kNone) << "there are neighbours that tell a rate";
  }
}

TEST(StateBuffer, TakesTheRateFromTheNearerNeighbour) {
  StateBuffer<double, 8> buffer;
  buffer.insert(at(1000), 1.0);
  buffer.insert(at(1400), 2.0);
  buffer.insert(at(9000), 50.0);
  const auto bracket = buffer.bracket(at(1400), kGap, kNone);
  ASSERT_TRUE(bracket);
  EXPECT_EQ(bracket->spacing, milliseconds{400});
  EXPECT_DOUBLE_EQ(bracket->interpolated(), 2.0);
}

TEST(StateBuffer, AnswersNearASampleHoweverFarTheNextOneIs) {
  StateBuffer<double, 8> buffer;
  buffer.insert(at(1000), 1.0);
  buffer.insert(at(9000), 9.0);
  for (const int ms : {1200, 8800}) {
    const auto bracket = buffer.bracket(at(ms), kGap, kNone);
    ASSERT_TRUE(bracket) << ms;
    EXPECT_DOUBLE_EQ(bracket->interpolated(), ms / 1000.0);
  }
  for (const int ms : {1201, 8799})
    EXPECT_EQ(buffer.bracket(at(ms), kGap, kNone).error(), NoState::kInAGap) << ms;
}

/// The oracle is a quantity that keeps its acceleration between the samples: the chord is off by the sagitta.
TEST(StateBuffer, SaysWhatInterpolationIsOffByWhereTheRateChanges) {
  const auto truth = [](double time_s) { return 3.0 + 2.0 * time_s - 0.5 * 4.0 * time_s * time_s; };
  for (const int spacing_ms : {100, 1000, 3000}) {
    StateBuffer<double, 8> buffer;
    buffer.insert(at(0), truth(0.0));
    buffer.insert(at(spacing_ms), truth(spacing_ms / 1000.0));
    for (const double share : {0.0, 0.1, 0.5, 0.8, 1.0}) {
      const int ms = static_cast<int>(spacing_ms * share);
      const auto bracket = buffer.bracket(at(ms), milliseconds{5000}, kNone);
      ASSERT_TRUE(bracket);
      EXPECT_NEAR(bracket->sigma(4.0), std::abs(bracket->interpolated() - truth(ms / 1000.0)), 1e-9);
    }
  }
}

TEST(StateBuffer, ExtrapolatesOnlyWithinTheLimit) {
  StateBuffer<double, 8> buffer;
  buffer.insert(at(100), 1.0);
  buffer.insert(at(200), 2.0);
  const auto bracket = buffer.bracket(at(205), kGap, milliseconds{5});
  ASSERT_TRUE(bracket);
  EXPECT_DOUBLE_EQ(bracket->interpolated(), 2.05);
  EXPECT_EQ(buffer.bracket(at(206), kGap, milliseconds{5}).error(), NoState::kNotYet);
}

TEST(StateBuffer, RefusesDuplicatesAndStaleSamplesAndCountsThem) {
  StateBuffer<double, 4> buffer;
  for (int i = 1; i <= 4; ++i) EXPECT_TRUE(buffer.insert(at(100 * i), i));
  EXPECT_FALSE(buffer.insert(at(200), 9.0));
  EXPECT_FALSE(buffer.insert(at(50), 9.0));  // older than all, and the buffer is full
  EXPECT_TRUE(buffer.insert(at(500), 5.0));  // pushes 100 ms out
  EXPECT_EQ(buffer.size(), 4U);
  EXPECT_EQ(buffer.counters().inserted, 5U);
  EXPECT_EQ(buffer.counters().duplicates, 1U);
  EXPECT_EQ(buffer.counters().stale, 1U);
  EXPECT_EQ(buffer.bracket(at(150), kGap, kNone).error(), NoState::kTooOld);
  EXPECT_DOUBLE_EQ(buffer.bracket(at(200), kGap, kNone)->interpolated(), 2.0);
}

class AnyOrder : public ::testing::TestWithParam<unsigned> {};

TEST_P(AnyOrder, GivesTheAnswersOfTheOrderedStream) {
  constexpr int kSamples = 64;
  std::vector<int> order(kSamples);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(GetParam());
  std::shuffle(order.begin(), order.end(), random);
  StateBuffer<double, kSamples> shuffled;
  for (const int i : order) shuffled.insert(at(10 * i), i * i);
  for (int ms = 0; ms <= 10 * (kSamples - 1); ms += 3) {
    const auto bracket = shuffled.bracket(at(ms), kGap, kNone);
    ASSERT_TRUE(bracket);
    const int i = std::min(ms / 10, kSamples - 2);
    const double alpha = (ms - 10 * i) / 10.0;
    EXPECT_NEAR(bracket->interpolated(), (1 - alpha) * i * i + alpha * (i + 1) * (i + 1), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyOrder, ::testing::Range(0U, 10U));

}  // namespace
}  // namespace geoloc
