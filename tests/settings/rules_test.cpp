// SPDX-License-Identifier: Apache-2.0
#include "settings/rules.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace geoloc {
namespace {

constexpr double kInfinity = Range::kInfinity;

TEST(Range, HoldsTheBoundsThatItIncludes) {
  const auto holds = [](const Range& range) {
    return std::array{range.contains(-1.5), range.contains(0.0), range.contains(1.0), range.contains(2.0),
                      range.contains(2.5)};
  };
  EXPECT_EQ(holds(Range::closed(0, 2)), (std::array{false, true, true, true, false}));
  EXPECT_EQ(holds(Range::open(0, 2)), (std::array{false, false, true, false, false}));
  EXPECT_EQ(holds(Range::above(0, 2)), (std::array{false, false, true, true, false}));
  EXPECT_EQ(holds(Range::below(0, 2)), (std::array{false, true, true, false, false}));
  EXPECT_EQ(holds(Range::at_least(0)), (std::array{false, true, true, true, true}));
  EXPECT_EQ(holds(Range::positive()), (std::array{false, false, true, true, true}));
  EXPECT_EQ(holds(Range::finite()), (std::array{true, true, true, true, true}));
}

TEST(Range, HoldsInfinityOnlyWhereItIncludesIt) {
  EXPECT_TRUE(Range::closed(0, kInfinity).contains(kInfinity));
  EXPECT_FALSE(Range::at_least(0).contains(kInfinity));
  EXPECT_FALSE(Range::positive().contains(kInfinity));
  EXPECT_FALSE(Range::finite().contains(-kInfinity));
}

TEST(Range, NeverHoldsNan) {
  EXPECT_FALSE(Range::closed(-kInfinity, kInfinity).contains(std::nan("")));
}

TEST(Texts, AreShortAndGiveTheSameNumberBack) {
  EXPECT_EQ(to_text(0.1), "0.1");
  EXPECT_EQ(to_text(100000.0), "100000");
  EXPECT_EQ(to_text(-1.0), "-1");
  for (const double value : {0.1 + 0.2, std::nextafter(1000.0, 2000.0), 1e300, 1e-300})
    EXPECT_EQ(std::stod("0" + to_text(value)), value);
  EXPECT_EQ(to_text(Range::above(0, 0.5)), "(0, 0.5]");
  EXPECT_EQ(to_text(Range::at_least(-90)), "[-90, inf)");
}

}  // namespace
}  // namespace geoloc
