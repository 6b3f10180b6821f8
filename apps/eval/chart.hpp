// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace geoloc::apps {

struct ChartAxis {
  std::string label;  ///< with the unit
  bool is_logarithmic = false;
  std::vector<double> ticks;  ///< all are shown; empty: round numbers that suit the data
};

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
  double sigma_y = 0.0;  ///< half the length of an error bar; 0: none
};

/// One of at most four things compared; its number chooses colour and mark.
struct ChartSeries {
  std::string name;
  int style = 0;
  bool is_line = false;
  std::vector<ChartPoint> points;
  bool has_marks = true;  ///< at its points
};

/// A line of texts under the axis, each at its place.
struct ChartRow {
  struct Cell {
    double x = 0.0;
    std::string text;
  };
  std::string name;
  int style = 0;  ///< of the series it belongs to
  std::vector<Cell> cells;
};

struct Chart {
  std::string title;
  ChartAxis x;
  ChartAxis y;
  std::vector<ChartSeries> series;
  std::vector<ChartRow> rows;
  std::optional<double> usual_x;  ///< marked: the value of all other runs
  std::optional<double> right_y;  ///< marked: what y should be
  bool has_diagonal = false;      ///< the line y = x
};

/// Rules for the classes in the drawings, for light and dark. A page holds them once.
std::string chart_css();

/// A drawing for a page that holds chart_css(). Texts are escaped; points that are not finite, or not above
/// zero on a logarithmic axis, are left out.
std::string to_svg_element(const Chart& chart);

/// The same as a file of its own.
std::string to_svg_file(const Chart& chart);

}  // namespace geoloc::apps
