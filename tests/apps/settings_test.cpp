// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "common/estimation_fields.hpp"
#include "support/setting_bounds.hpp"

namespace geoloc::apps {
namespace {

TEST(EstimationConfig, KeepsTheBoundsOfEverySectionWhenItIsLoaded) {
  const auto problems_of = [](EstimationConfig config) {
    std::vector<std::string> problems;
    estimation_from_json(nlohmann::json::object(), {}, config, problems);
    return problems;
  };
  EXPECT_GT(testing::expect_bounds_are_kept<EstimationConfig>(problems_of), 400U);
}

}  // namespace
}  // namespace geoloc::apps
