// SPDX-License-Identifier: Apache-2.0
#include "eval/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "eval/axis_scale.hpp"
#include "geoloc/io/output/markup.hpp"
#include "geoloc/io/output/palette.hpp"

namespace geoloc::apps {
namespace {

// One size for all drawings, small enough to be read on a telephone without zooming.
constexpr double kWidth = 420.0;
constexpr double kLeft = 78.0;
constexpr double kRight = kWidth - 18.0;
constexpr double kTop = 56.0;
constexpr double kPlotHeight = 210.0;
constexpr double kBottom = kTop + kPlotHeight;
constexpr double kRowHeight = 17.0;
constexpr double kRowsTop = kBottom + 56.0;
constexpr int kStyles = 4;

constexpr const char* kShapes =
    R"(.gc{font-family:system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
.gc-title{font-size:14.5px;font-weight:600}.gc-label{font-size:12.5px}.gc-tick,.gc-cell{font-size:11.5px}
.gc-grid,.gc-axis,.gc-guide{fill:none}.gc-guide{stroke-dasharray:3 4}.gc-line{fill:none;stroke-width:2.2}.gc-bar{stroke-opacity:.45}
.gc-m{stroke-width:0;fill-opacity:.85}polyline.gc-line{fill:none}polyline.gc-0{stroke-dasharray:7 4}
)";
constexpr const char* kColours =
    R"(.gc-back{fill:var(--card)}.gc-title,.gc-cell{fill:var(--ink)}.gc-label,.gc-tick{fill:var(--soft)}
.gc-grid{stroke:var(--grid)}.gc-axis,.gc-guide{stroke:var(--trajectory)}
.gc-0{fill:var(--tentative);stroke:var(--tentative)}.gc-1{fill:var(--object);stroke:var(--object)}
.gc-2{fill:var(--footprint);stroke:var(--footprint)}.gc-3{fill:var(--target);stroke:var(--target)}
)";

struct Plane {
  AxisScale x;
  AxisScale y;
};

Plane plane_of(const Chart& chart) {
  ValueRange x, y;
  for (const ChartSeries& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
      if (!chart.x.is_logarithmic || point.x > 0.0) x.add(point.x);
      for (const double end : {point.y - point.sigma_y, point.y + point.sigma_y}) {
        if (!chart.y.is_logarithmic || end > 0.0) y.add(end);
      }
    }
  }
  if (chart.right_y) y.add(*chart.right_y);
  return {AxisScale(chart.x, x, kLeft, kRight), AxisScale(chart.y, y, kBottom, kTop)};
}

void draw_axes(const Chart& chart, const Plane& plane, std::string& svg) {
  const auto out = std::back_inserter(svg);
  for (const double tick : plane.y.ticks()) {
    const double y = plane.y.px(tick);
    fmt::format_to(out, "<path class=\"gc-grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", kLeft, y, kRight);
    fmt::format_to(out,
                   "<text class=\"gc-tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:.4g}</text>\n",
                   kLeft - 7.0, y + 4.0, tick);
  }
  for (const double tick : plane.x.ticks()) {
    const double x = plane.x.px(tick);
    fmt::format_to(out, "<path class=\"gc-grid\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>", x, kTop, kBottom);
    fmt::format_to(out,
                   "<text class=\"gc-tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:.4g}</text>\n",
                   x, kBottom + 16.0, tick);
  }
  fmt::format_to(out, "<path class=\"gc-axis\" d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\"/>\n", kLeft, kTop, kBottom,
                 kRight);
  fmt::format_to(out, "<text class=\"gc-label\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                 0.5 * (kLeft + kRight), kBottom + 36.0, io::escape_markup(chart.x.label));
  fmt::format_to(out,
                 "<text class=\"gc-label\" transform=\"translate(16 {:.1f}) rotate(-90)\" "
                 "text-anchor=\"middle\">{}</text>\n",
                 0.5 * (kTop + kBottom), io::escape_markup(chart.y.label));
}

void draw_guides(const Chart& chart, const Plane& plane, std::string& svg) {
  const auto out = std::back_inserter(svg);
  if (chart.usual_x && plane.x.holds(*chart.usual_x)) {
    fmt::format_to(out, "<path class=\"gc-guide\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n",
                   plane.x.px(*chart.usual_x), kTop, kBottom);
  }
  if (chart.right_y && plane.y.holds(*chart.right_y)) {
    const double y = plane.y.px(*chart.right_y);
    fmt::format_to(out, "<path class=\"gc-guide\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", kLeft, y, kRight);
  }
  if (!chart.has_diagonal) return;
  const double low = std::max(plane.x.low(), plane.y.low()), high = std::min(plane.x.high(), plane.y.high());
  if (!(low < high)) return;
  fmt::format_to(out, "<path class=\"gc-guide\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", plane.x.px(low),
                 plane.y.px(low), plane.x.px(high), plane.y.px(high));
}

/// A square, a disc, a diamond, a triangle: told apart without colours.
void draw_mark(double x, double y, int style, double radius, std::string& svg) {
  const auto out = std::back_inserter(svg);
  switch (style % kStyles) {
    case 0:
      fmt::format_to(
          out, "<rect class=\"gc-m gc-0\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>",
          x - 0.9 * radius, y - 0.9 * radius, 1.8 * radius, 1.8 * radius);
      break;
    case 1:
      fmt::format_to(out, "<circle class=\"gc-m gc-1\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>", x, y,
                     radius);
      break;
    case 2:
      fmt::format_to(out,
                     "<path class=\"gc-m gc-2\" d=\"M{0:.1f} {1:.1f}l{2:.1f} {2:.1f}l-{2:.1f} "
                     "{2:.1f}l-{2:.1f} -{2:.1f}z\"/>",
                     x, y - 1.2 * radius, 1.2 * radius);
      break;
    default:
      fmt::format_to(out, "<path class=\"gc-m gc-3\" d=\"M{:.1f} {:.1f}l{:.1f} {:.1f}h-{:.1f}z\"/>", x,
                     y - 1.1 * radius, 1.1 * radius, 1.9 * radius, 2.2 * radius);
  }
}

void draw_series(const ChartSeries& series, const Plane& plane, std::string& svg) {
  const auto out = std::back_inserter(svg);
  std::string line, marks;
  for (const ChartPoint& point : series.points) {
    if (!plane.x.holds(point.x) || !plane.y.holds(point.y)) continue;
    const double x = plane.x.px(point.x), y = plane.y.px(point.y);
    fmt::format_to(std::back_inserter(line), "{:.1f},{:.1f} ", x, y);
    if (point.sigma_y > 0.0 && plane.y.holds(point.y - point.sigma_y)) {
      fmt::format_to(std::back_inserter(marks), "<path class=\"gc-bar gc-{}\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>",
                     series.style % kStyles, x, plane.y.px(point.y - point.sigma_y),
                     plane.y.px(point.y + point.sigma_y));
    }
    if (series.has_marks) draw_mark(x, y, series.style, series.is_line ? 4.0 : 3.0, marks);
  }
  if (series.is_line)
    fmt::format_to(out, "<polyline class=\"gc-line gc-{}\" points=\"{}\"/>", series.style % kStyles, line);
  svg += marks + "\n";
}

void draw_legend(const Chart& chart, std::string& svg) {
  double x = kLeft + 4.0;
  for (const ChartSeries& series : chart.series) {
    draw_mark(x, 38.0, series.style, 4.0, svg);
    fmt::format_to(std::back_inserter(svg), "<text class=\"gc-label\" x=\"{:.1f}\" y=\"42\">{}</text>\n",
                   x + 10.0, io::escape_markup(series.name));
    x += 34.0 + 6.6 * static_cast<double>(series.name.size());
  }
}

void draw_rows(const Chart& chart, const Plane& plane, std::string& svg) {
  const auto out = std::back_inserter(svg);
  double y = kRowsTop;
  for (const ChartRow& row : chart.rows) {
    draw_mark(9.0, y - 4.0, row.style, 3.4, svg);
    fmt::format_to(out, "<text class=\"gc-tick\" x=\"18\" y=\"{:.1f}\">{}</text>", y,
                   io::escape_markup(row.name));
    for (const ChartRow::Cell& cell : row.cells) {
      if (!plane.x.holds(cell.x)) continue;
      fmt::format_to(out,
                     "<text class=\"gc-cell\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>",
                     plane.x.px(cell.x), y, io::escape_markup(cell.text));
    }
    svg += "\n";
    y += kRowHeight;
  }
}

std::string draw(const Chart& chart, const std::string& attributes, const std::string& first) {
  const Plane plane = plane_of(chart);
  const double rows = kRowHeight * static_cast<double>(chart.rows.size());
  const double height = chart.rows.empty() ? kBottom + 46.0 : kRowsTop + rows - 6.0;
  std::string svg =
      fmt::format("<svg class=\"gc\" role=\"img\" viewBox=\"0 0 {:.0f} {:.0f}\"{}>\n{}<title>{}</title>\n",
                  kWidth, height, attributes, first, io::escape_markup(chart.title));
  fmt::format_to(std::back_inserter(svg), "<text class=\"gc-title\" x=\"12\" y=\"19\">{}</text>\n",
                 io::escape_markup(chart.title));
  draw_axes(chart, plane, svg);
  draw_guides(chart, plane, svg);
  for (const ChartSeries& series : chart.series) draw_series(series, plane, svg);
  draw_legend(chart, svg);
  draw_rows(chart, plane, svg);
  return svg + "</svg>\n";
}

}  // namespace

std::string chart_css() {
  return kShapes + io::with_colours(kColours, io::ColourScheme::kLight) +
         "@media (prefers-color-scheme:dark){" + io::with_colours(kColours, io::ColourScheme::kDark) + "}\n";
}

std::string to_svg_element(const Chart& chart) {
  return draw(chart, "", "");
}

std::string to_svg_file(const Chart& chart) {
  return draw(
      chart, " width=\"100%\" height=\"100%\" xmlns=\"http://www.w3.org/2000/svg\"",
      "<style>" + chart_css() + "</style>\n<rect class=\"gc-back\" width=\"100%\" height=\"100%\"/>\n");
}

}  // namespace geoloc::apps
