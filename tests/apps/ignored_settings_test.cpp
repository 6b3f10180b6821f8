// SPDX-License-Identifier: Apache-2.0
#include "common/ignored_settings.hpp"

#include <gtest/gtest.h>

namespace geoloc::apps {
namespace {

using nlohmann::json;

const std::vector<Ignored> kIgnored{{"detection", "nobody detects"}, {"mavlink.camera", "nobody listens"}};

TEST(IgnoredSettings, AreNamedByReason) {
  const json document{{"detection", {{"confidence", 0.5}, {"second_look", {{"confidence", 0.1}}}}},
                      {"mavlink", {{"camera", true}, {"system_id", 3}}},
                      {"detections", {{"confidence", 0.5}}}};
  EXPECT_EQ(
      ignored_settings(document, json::object(), kIgnored, "a.json"),
      (std::vector<std::string>{"a.json: without effect here, since nobody detects: detection.confidence, "
                                "detection.second_look.confidence",
                                "a.json: without effect here, since nobody listens: mavlink.camera"}));
}

TEST(IgnoredSettings, ThatChangeNothingAnywayAreNotNamed) {
  const json document{{"detection", {{"confidence", 0.5}, {"threads", 1}}}};
  EXPECT_TRUE(ignored_settings(document, document, kIgnored, "a.json").empty());
  EXPECT_EQ(ignored_settings(document, {{"detection", {{"threads", 1}}}}, kIgnored, "a.json").size(), 1U);
  EXPECT_TRUE(ignored_settings(json(), json(), kIgnored, "a.json").empty());
}

TEST(IgnoredSettings, OfManyThreeAreNamed) {
  const json document{{"detection", {{"a", 1}, {"b", 1}, {"c", 1}, {"d", 1}, {"e", 1}}}};
  EXPECT_EQ(ignored_settings(document, json::object(), kIgnored, "x").front(),
            "x: without effect here, since nobody detects: detection.a, detection.b, detection.c and 2 more");
}

}  // namespace
}  // namespace geoloc::apps
