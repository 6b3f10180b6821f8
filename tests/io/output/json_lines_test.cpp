// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/json_lines.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

OutputFrame frame_with(std::vector<std::pair<std::uint64_t, int>> ids_and_hits, Duration after_start) {
  OutputFrame frame;
  frame.captured_at = HostTime{1'795'300'000s} + after_start;
  for (const auto& [id, hits] : ids_and_hits) {
    ObjectReport object;
    object.id = id;
    object.hits = hits;
    object.position = {-22.9, -43.1};
    frame.objects.push_back(object);
  }
  return frame;
}

/// "frame object:3 removed:1", for short.
std::string shape(const std::string& lines) {
  std::string all;
  std::istringstream input(lines);
  for (std::string line; std::getline(input, line);) {
    const auto json = nlohmann::json::parse(line);
    all += (all.empty() ? "" : " ") + json["type"].get<std::string>();
    if (json.contains("id")) all += ":" + json["id"].dump();
  }
  return all;
}

TEST(JsonLines, TellAnObjectWhenItIsNewAndWhenItIsGone) {
  JsonLines lines;
  EXPECT_EQ(shape(lines.frame(frame_with({}, 0s))), "frame");
  EXPECT_EQ(shape(lines.frame(frame_with({{1, 3}, {2, 3}}, 1s))), "frame object:1 object:2");
  EXPECT_EQ(shape(lines.frame(frame_with({{2, 3}}, 2s))), "frame removed:1");
  EXPECT_EQ(shape(lines.frame(frame_with({{2, 3}}, 3s))), "frame");
}

/// However it went: merged, removed, or no longer believed.
TEST(JsonLines, SayOnceThatAnObjectIsRetractedAndTellItAnewWhenItIsBack) {
  JsonLines lines;
  lines.frame(frame_with({{1, 3}}, 0s));
  const std::string gone = lines.frame(frame_with({}, 1s));
  const auto json = nlohmann::json::parse(gone.substr(gone.find('\n') + 1));
  EXPECT_EQ(json["type"], "removed");
  EXPECT_EQ(json["id"], 1);
  EXPECT_EQ(json["status"], "retracted");
  for (int i = 0; i < 3; ++i) EXPECT_EQ(shape(lines.frame(frame_with({}, 2s))), "frame");
  EXPECT_EQ(shape(lines.frame(frame_with({{1, 4}}, 3s))), "frame object:1");
  EXPECT_EQ(shape(lines.frame(frame_with({}, 4s))), "frame removed:1");
}

TEST(JsonLines, SayNothingOfAnObjectThatWasOnlyEverTentative) {
  JsonLines lines;
  OutputFrame frame = frame_with({{1, 3}}, 0s);
  frame.tentative = std::move(frame.objects);
  frame.objects.clear();
  EXPECT_EQ(shape(lines.frame(frame)), "frame");
  EXPECT_EQ(shape(lines.frame(frame_with({}, 1s))), "frame");
}

TEST(JsonLines, TellAnObjectThatIsSeenAgainOnceASecond) {
  JsonLines lines;
  int told = 0;
  for (int i = 0; i < 100; ++i) {  // at 10 Hz
    const std::string said = shape(lines.frame(frame_with({{1, 3 + i}}, i * 100ms)));
    told += said == "frame object:1" ? 1 : 0;
  }
  EXPECT_EQ(told, 10);
}

TEST(JsonLines, SayWhetherAFrameWasLocated) {
  OutputFrame frame = frame_with({}, 0s);
  auto json = nlohmann::json::parse(JsonLines().frame(frame));
  EXPECT_EQ(json["located"], false);
  EXPECT_FALSE(json.contains("vehicle"));
  frame.view.emplace();
  json = nlohmann::json::parse(JsonLines().frame(frame));
  EXPECT_EQ(json["located"], true);
  EXPECT_TRUE(json["footprint"].is_null());
  EXPECT_EQ(json["time_us"], 1'795'300'000'000'000);
}

TEST(JsonLines, EndWithEveryObjectAndTheRun) {
  RunRecord run;
  run.objects = frame_with({{1, 3}, {4, 3}}, 0s).objects;
  EXPECT_EQ(shape(JsonLines::end(run)), "object:1 object:4 run");
}

}  // namespace
}  // namespace geoloc::io
