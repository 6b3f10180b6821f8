// SPDX-License-Identifier: Apache-2.0
#include "eval/chart.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "eval/axis_scale.hpp"
#include "eval/html_table.hpp"

namespace geoloc::apps {
namespace {

Chart small_chart() {
  Chart chart;
  chart.title = "Errors";
  chart.x = {"height, m", true, {10.0, 20.0}};
  chart.y = {"RMSE, m", true, {}};
  chart.series.push_back({"joint", 1, true, {{10.0, 0.1, 0.0}, {20.0, 0.2, 0.05}}});
  return chart;
}

std::size_t count_of(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(Chart, EscapesEveryText) {
  Chart chart = small_chart();
  const std::string hostile = "<script>&\"";
  chart.title = chart.x.label = chart.y.label = chart.series[0].name = hostile;
  chart.rows.push_back({hostile, 0, {{10.0, hostile}}});
  const std::string svg = to_svg_element(chart);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_EQ(count_of("&lt;script&gt;&amp;&quot;", svg), 7U);  // the title stands twice
}

TEST(Chart, LeavesOutWhatItsAxesCannotShow) {
  Chart chart = small_chart();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  auto& points = chart.series[0].points;
  points.insert(points.end(), {{kNan, 0.1, 0.0}, {15.0, kNan, 0.0}, {15.0, 0.0, 0.0}, {-1.0, 0.1, 0.0}});
  points.push_back({std::numeric_limits<double>::infinity(), 0.1, 0.0});
  const std::string svg = to_svg_element(chart);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_EQ(svg, to_svg_element(small_chart()));
}

TEST(Chart, IsDrawnWithoutData) {
  const std::string svg = to_svg_file(Chart{});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(AxisScale, TicksAreRoundAndWithin) {
  for (const bool is_logarithmic : {false, true}) {
    for (const double low : {1e-9, 0.013, 0.7, 42.0, 1e9}) {
      for (const double ratio : {1.0, 1.5, 8.0, 1e3}) {
        const AxisScale scale({"", is_logarithmic, {}}, {low, ratio * low}, 0.0, 100.0);
        ASSERT_LE(scale.ticks().size(), 40U);
        for (const double tick : scale.ticks()) {
          const double digits = tick / std::pow(10.0, std::floor(std::log10(std::abs(tick))) - 2.0);
          ASSERT_TRUE(tick == 0.0 || std::abs(digits - std::round(digits)) < 1e-6) << tick;
          ASSERT_GE(scale.px(tick), -1e-6);
          ASSERT_LE(scale.px(tick), 100.0 + 1e-6);
        }
      }
    }
  }
}

TEST(AxisScale, EndsOfTheRangeLieWithinTheBorder) {
  const AxisScale scale({"", true, {}}, {0.1, 10.0}, 400.0, 0.0);  // upwards, as y is drawn
  EXPECT_NEAR(scale.px(1.0), 200.0, 1e-9);
  EXPECT_GT(scale.px(10.0), 10.0);
  EXPECT_LT(scale.px(0.1), 390.0);
}

TEST(Chart, FileBringsItsStyleAndAnElementDoesNot) {
  EXPECT_NE(to_svg_file(small_chart()).find("prefers-color-scheme:dark"), std::string::npos);
  EXPECT_EQ(to_svg_element(small_chart()).find("<style"), std::string::npos);
}

TEST(HtmlTable, EscapesItsTextsAndNamesItsRows) {
  const std::string html = to_html(HtmlTable{"a & b", {"<h>"}, {{"<row>", "1 < 2"}}});
  EXPECT_NE(html.find("<caption>a &amp; b</caption>"), std::string::npos);
  EXPECT_NE(html.find("<th>&lt;h&gt;</th>"), std::string::npos);
  EXPECT_NE(html.find("<th scope=\"row\">&lt;row&gt;</th><td>1 &lt; 2</td>"), std::string::npos);
}

}  // namespace
}  // namespace geoloc::apps
