// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/state_buffer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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
  EXPECT_EQ(buffer.bracket(at(1000), kGap, kNone).error(), NoState::kNotYet);  // one sample has no rate
  buffer.insert(at(1100), 2.0);
  buffer.insert(at(2000), 3.0);
  buffer.insert(at(2100), 3.0);
  EXPECT_EQ(buffer.bracket(at(999), kGap, kNone).error(), NoState::kTooOld);
  EXPECT_EQ(buffer.bracket(at(1500), kGap, kNone).error(), NoState::kInAGap);
  EXPECT_EQ(buffer.bracket(at(2101), kGap, kNone).error(), NoState::kNotYet);
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
