// SPDX-License-Identifier: Apache-2.0
#include "common/command_line.hpp"

#include <gtest/gtest.h>

namespace geoloc::apps {
namespace {

TEST(CommandLine, AMistypedNameIsMeantForTheNearest) {
  const std::vector<std::string> names{"--out", "--config", "--known-points", "--help"};
  EXPECT_EQ(nearest_name("--ouy", names), "--out");
  EXPECT_EQ(nearest_name("--output", names), "");
  EXPECT_EQ(nearest_name("--confg", names), "--config");
  EXPECT_EQ(nearest_name("--known", names), "--known-points");
  EXPECT_EQ(nearest_name("--colour", names), "");
  EXPECT_EQ(nearest_name("--", names), "");
}

TEST(CommandLine, WholeNumbersAreDigitsAndFit) {
  const CLI::Validator is_whole = whole_number();
  for (std::string good : {"0", "1", "18446744073709551615"}) EXPECT_EQ(is_whole(good), "") << good;
  for (std::string bad : {"-1", "", " 1", "1.5", "18446744073709551616", "one", "1e3", "+1"})
    EXPECT_NE(is_whole(bad), "") << bad;
}

}  // namespace
}  // namespace geoloc::apps
