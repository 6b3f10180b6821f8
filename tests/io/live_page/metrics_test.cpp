// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <sstream>
#include <string>

#include "geoloc/io/live_page/live_site.hpp"

namespace geoloc::io {
namespace {

/// The figures by their names; fails where a figure has no help, no type, or comes twice.
std::map<std::string, double> read_metrics(const std::string& text) {
  std::map<std::string, double> values;
  std::istringstream lines(text);
  std::string help, type, figure;
  while (std::getline(lines, help) && std::getline(lines, type) && std::getline(lines, figure)) {
    const std::string name = figure.substr(0, figure.find(' '));
    EXPECT_EQ(help.rfind("# HELP " + name + " ", 0), 0U) << help;
    const bool is_total = name.size() > 6 && name.compare(name.size() - 6, 6, "_total") == 0;
    EXPECT_EQ(type, "# TYPE " + name + (is_total ? " counter" : " gauge"));
    EXPECT_TRUE(values.emplace(name, std::stod(figure.substr(name.size()))).second) << name;
  }
  return values;
}

class MetricsOfAPage : public ::testing::Test {
 protected:
  PageAnswer get(const LiveSite& site) const { return site.answer({"GET", "/metrics", "localhost", "", ""}); }

  LiveDocument document{{"run", true}};
  PictureBoard board{{"target"}, std::chrono::milliseconds{100}};
};

TEST_F(MetricsOfAPage, TellTheStatusOfALiveRunInBaseUnits) {
  LiveStatus status;
  status.elapsed = std::chrono::milliseconds{1500};
  status.link_is_good = true;
  status.detect_ms = 250.0;
  status.latency_ms = 400.0;
  status.video_rate_hz = 9.5;
  status.frames_dropped = 18'446'744'073'709'551'615U;
  document.add(status);
  const LiveSite site{document, board, {}, {"localhost"}};
  const PageAnswer answer = get(site);
  EXPECT_EQ(answer.type, "text/plain; version=0.0.4; charset=utf-8");
  const auto values = read_metrics(answer.body);
  EXPECT_EQ(values.at("geoloc_run_seconds"), 1.5);
  EXPECT_EQ(values.at("geoloc_telemetry_up"), 1.0);
  EXPECT_EQ(values.at("geoloc_video_up"), 0.0);
  EXPECT_EQ(values.at("geoloc_detection_seconds"), 0.25);
  EXPECT_EQ(values.at("geoloc_delay_seconds"), 0.4);
  EXPECT_EQ(values.at("geoloc_video_rate_hertz"), 9.5);
  EXPECT_EQ(values.at("geoloc_frames_dropped_total"), 18'446'744'073'709'551'615.0);
  EXPECT_EQ(values.at("geoloc_objects"), 0.0);
}

TEST_F(MetricsOfAPage, TellNothingOfLiveInputsBeforeThereIsAny) {
  const LiveSite site{document, board, {}, {"localhost"}};
  const auto values = read_metrics(get(site).body);
  EXPECT_EQ(values.at("geoloc_frames_total"), 0.0);
  EXPECT_EQ(values.count("geoloc_telemetry_up"), 0U);
  EXPECT_EQ(values.count("geoloc_latency_seconds"), 0U);
}

TEST_F(MetricsOfAPage, AreForThoseWhoHaveTheToken) {
  const LiveSite site{document, board, {}, {"localhost"}, "a-token-of-sufficient-length"};
  EXPECT_EQ(get(site).status, 401);
}

}  // namespace
}  // namespace geoloc::io
