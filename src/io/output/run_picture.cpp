// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/run_picture.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "geoloc/io/output/markup.hpp"
#include "geoloc/io/output/palette.hpp"

namespace geoloc::io {
namespace {

constexpr double kWidth_px = 1000.0;
constexpr double kHeader_px = 70.0;
constexpr double kFooter_px = 56.0;
constexpr double kMargin_px = 46.0;

constexpr const char* kShapes = R"(
 text{font-family:system-ui,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
 .title{font-size:22px;font-weight:600}.subtitle{font-size:14px}.axis{font-size:11px}.legend{font-size:13px}
 .id{font-size:10px;font-weight:600}.trajectory{fill:none;stroke-width:1.4}.raw{fill-opacity:.35}
 .target{fill:none;stroke-width:1.4}.object{stroke-width:1}.ellipse{fill-opacity:.13;stroke-opacity:.75}
)";
constexpr const char* kColours = R"(
 .page{fill:var(--page)}.frame{fill:var(--map);stroke:var(--line)}.grid{stroke:var(--grid)}
 .title,.id{fill:var(--ink)}.subtitle,.axis,.legend{fill:var(--soft)}.trajectory{stroke:var(--trajectory)}
 .raw{fill:var(--raw)}.target{stroke:var(--target)}.object{fill:var(--object);stroke:var(--map)}
 .ellipse{fill:var(--object);stroke:var(--object)}
)";

std::string style() {
  return std::string("<style>") + kShapes + with_colours(kColours, ColourScheme::kLight) +
         "@media (prefers-color-scheme:dark){" + with_colours(kColours, ColourScheme::kDark) + "}</style>\n";
}

/// Maps east and north to pixels of the picture, with the same scale on both axes and north up.
class Map {
 public:
  explicit Map(const Eigen::AlignedBox2d& area) : area_(area) {
    scale_ = (kWidth_px - 2.0 * kMargin_px) / area.sizes().x();
  }
  double x(double east_m) const { return kMargin_px + (east_m - area_.min().x()) * scale_; }
  double y(double north_m) const { return kHeader_px + (area_.max().y() - north_m) * scale_; }
  double length(double metres) const { return metres * scale_; }
  double bottom() const { return y(area_.min().y()); }
  const Eigen::AlignedBox2d& area() const { return area_; }

 private:
  Eigen::AlignedBox2d area_;
  double scale_;
};

/// The area of everything shown, with a border; at least 10 m, and not more than four times as high as wide.
Eigen::AlignedBox2d area_of(const RunPicture& picture) {
  Eigen::AlignedBox2d area;
  for (const auto* points : {&picture.targets, &picture.raw_fixes, &picture.trajectory}) {
    for (const Eigen::Vector2d& point : *points) {
      if (point.allFinite()) area.extend(point);
    }
  }
  for (const ObjectReport& object : picture.objects) area.extend(object.position_in_enu);
  if (area.isEmpty()) area.extend(Eigen::Vector2d::Zero());
  const double border_m = std::max(5.0, 0.04 * area.sizes().maxCoeff());
  area = {area.min().array() - border_m, area.max().array() + border_m};
  const double missing_m = 0.25 * area.sizes().y() - area.sizes().x();
  if (missing_m > 0.0) {
    area.min().x() -= 0.5 * missing_m;
    area.max().x() += 0.5 * missing_m;
  }
  return area;
}

/// 1, 2 or 5 times a power of ten, for about eight lines.
double grid_step(double span_m) {
  const double rough = span_m / 8.0;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (rough <= factor * decade) return factor * decade;
  }
  return 10.0 * decade;
}

void draw_grid(const Map& map, std::string& svg) {
  const auto out = std::back_inserter(svg);
  const Eigen::AlignedBox2d& area = map.area();
  const double left = map.x(area.min().x()), right = map.x(area.max().x());
  const double top = map.y(area.max().y()), bottom = map.bottom();
  fmt::format_to(out,
                 "<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
                 left, top, right - left, bottom - top);
  const double step = grid_step(area.sizes().maxCoeff());
  for (double east = std::ceil(area.min().x() / step) * step; east <= area.max().x(); east += step) {
    fmt::format_to(out, "<path class=\"grid\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/>", map.x(east), top, bottom);
    fmt::format_to(out, "<text class=\"axis\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:g}</text>\n",
                   map.x(east), bottom + 15.0, std::round(east));
  }
  for (double north = std::ceil(area.min().y() / step) * step; north <= area.max().y(); north += step) {
    fmt::format_to(out, "<path class=\"grid\" d=\"M{0:.1f} {1:.1f}H{2:.1f}\"/>", left, map.y(north), right);
    fmt::format_to(out, "<text class=\"axis\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>\n",
                   left - 6.0, map.y(north) + 4.0, std::round(north));
  }
}

void draw_trajectory(const Map& map, const std::vector<Eigen::Vector2d>& trajectory, std::string& svg) {
  svg += "<polyline class=\"trajectory\" points=\"";
  for (const Eigen::Vector2d& point : trajectory) {
    if (point.allFinite())
      fmt::format_to(std::back_inserter(svg), "{:.1f},{:.1f} ", map.x(point.x()), map.y(point.y()));
  }
  svg += "\"/>\n";
}

void draw_raw_fixes(const Map& map, const std::vector<Eigen::Vector2d>& fixes, std::string& svg) {
  svg += "<g class=\"raw\">";
  for (const Eigen::Vector2d& fix : fixes) {
    if (!fix.allFinite()) continue;
    fmt::format_to(std::back_inserter(svg), "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.7\"/>", map.x(fix.x()),
                   map.y(fix.y()));
  }
  svg += "</g>\n";
}

void draw_target(double x, double y, std::string& svg) {
  constexpr double kHalf = 5.0;
  fmt::format_to(std::back_inserter(svg),
                 "<rect class=\"target\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.0f}\" height=\"{:.0f}\"/>\n",
                 x - kHalf, y - kHalf, 2.0 * kHalf, 2.0 * kHalf);
}

void draw_object(const Map& map, const ObjectReport& object, std::string& svg) {
  const auto out = std::back_inserter(svg);
  const double x = map.x(object.position_in_enu.x()), y = map.y(object.position_in_enu.y());
  // The major axis is turned from the picture's vertical, clockwise, by its azimuth.
  fmt::format_to(out,
                 "<ellipse class=\"ellipse\" cx=\"{0:.1f}\" cy=\"{1:.1f}\" rx=\"{2:.1f}\" ry=\"{3:.1f}\" "
                 "transform=\"rotate({4:.1f} {0:.1f} {1:.1f})\"/>",
                 x, y, map.length(kDrawnSigmas * object.ellipse.sigma_minor_m),
                 map.length(kDrawnSigmas * object.ellipse.sigma_major_m), object.ellipse.azimuth_deg);
  fmt::format_to(
      out, "<circle class=\"object\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.4\"><title>{}</title></circle>", x, y,
      escape_markup(fmt::format("object {} · {} · {:.7f}, {:.7f} · {} looks", object.id, object.class_name,
                                object.position.latitude_deg, object.position.longitude_deg, object.hits)));
  fmt::format_to(out, "<text class=\"id\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x + 6.0, y - 5.0,
                 object.id);
}

void draw_legend(const Map& map, const RunPicture& picture, std::string& svg) {
  const auto out = std::back_inserter(svg);
  const double y = map.bottom() + 40.0;
  double x = kMargin_px + 6.0;
  const auto label = [&](const std::string& text) {
    fmt::format_to(out, "<text class=\"legend\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x + 14.0, y + 4.5,
                   text);
    x += 46.0 + 7.0 * static_cast<double>(text.size());
  };
  if (!picture.targets.empty()) {
    draw_target(x, y, svg);
    label("true target");
  }
  fmt::format_to(out, "<circle class=\"object\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.4\"/>", x, y);
  label("confirmed object, 2-sigma ellipse");
  fmt::format_to(out, "<circle class=\"raw\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>", x, y);
  label("raw fix");
  fmt::format_to(out, "<path class=\"trajectory\" d=\"M{:.1f} {:.1f}h16\"/>", x - 6.0, y);
  label("trajectory");
  fmt::format_to(
      out, "<text class=\"legend\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">metres east, north</text>\n",
      kWidth_px - kMargin_px, y + 4.5);
}

}  // namespace

RunPicture picture_of(const RunRecord& run) {
  RunPicture picture;
  picture.title = run.title;
  picture.subtitle = run.summary.substr(0, run.summary.find('\n'));
  picture.targets = run.targets;
  for (const RawFix& fix : run.raw_fixes) picture.raw_fixes.push_back(fix.position_in_enu);
  for (const TrajectoryPoint& point : run.trajectory)
    picture.trajectory.push_back(point.position_in_enu.head<2>());
  picture.objects = run.objects;
  return picture;
}

std::string to_svg(const RunPicture& picture) {
  const Map map(area_of(picture));
  const double height_px = map.bottom() + kFooter_px;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"100%\" "
      "height=\"100%\">\n",
      kWidth_px, height_px);
  svg += style();
  svg += "<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n";
  fmt::format_to(std::back_inserter(svg), "<text class=\"title\" x=\"{0:.0f}\" y=\"32\">{1}</text>\n",
                 kMargin_px, escape_markup(picture.title));
  fmt::format_to(std::back_inserter(svg), "<text class=\"subtitle\" x=\"{0:.0f}\" y=\"54\">{1}</text>\n",
                 kMargin_px, escape_markup(picture.subtitle));
  draw_grid(map, svg);
  draw_trajectory(map, picture.trajectory, svg);
  draw_raw_fixes(map, picture.raw_fixes, svg);
  for (const Eigen::Vector2d& target : picture.targets)
    draw_target(map.x(target.x()), map.y(target.y()), svg);
  for (const ObjectReport& object : picture.objects) draw_object(map, object, svg);
  draw_legend(map, picture, svg);
  return svg + "</svg>\n";
}

}  // namespace geoloc::io
