// SPDX-License-Identifier: Apache-2.0
#include "geoloc/projection/height_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/problems.hpp"
#include "geoloc/geometry/refuse.hpp"

namespace geoloc {
namespace {

/// A degree of latitude, to a percent.
constexpr double kMetresPerDegree = 111.2e3;

double north_of(const HeightGrid::Layout& layout) {
  return layout.south_deg + static_cast<double>(layout.rows - 1) * layout.latitude_step_deg;
}

double width_deg(const HeightGrid::Layout& layout) {
  return static_cast<double>(layout.columns - 1) * layout.longitude_step_deg;
}

/// Written so that what is not a number is no grid either.
bool is_on_earth(const HeightGrid::Layout& layout) {
  return layout.rows >= 2 && layout.columns >= 2 && layout.latitude_step_deg > 0.0 &&
         layout.longitude_step_deg > 0.0 && layout.south_deg >= -90.0 && north_of(layout) <= 90.0 &&
         std::abs(layout.west_deg) <= 360.0 && width_deg(layout) <= 360.0;
}

double metres_per_degree_of_longitude(double latitude_deg) {
  return kMetresPerDegree * std::cos(latitude_deg * kRadPerDeg);
}

/// A place between two nodes of an axis; beyond its ends that of the end.
struct Span {
  std::size_t first;
  double weight_of_second;
  double beyond;  ///< in steps
};

Span span_at(double steps, std::size_t nodes) {
  const double inside = std::clamp(steps, 0.0, static_cast<double>(nodes - 1));
  const auto first = std::min(static_cast<std::size_t>(inside), nodes - 2);
  return {first, inside - static_cast<double>(first), std::abs(steps - inside)};
}

}  // namespace

std::vector<std::string> HeightGrid::problems(const Layout& layout, const std::vector<float>& heights_m) {
  Problems found;
  const bool lies_on_earth = is_on_earth(layout);
  found.require(lies_on_earth, "the heights' grid does not lie on Earth");
  found.require(!lies_on_earth || (heights_m.size() / layout.columns == layout.rows &&
                                   heights_m.size() % layout.columns == 0),
                "the heights' grid has another number of nodes than heights");
  const auto is_infinite = [](float height_m) { return std::isinf(height_m); };
  const auto is_known = [](float height_m) { return std::isfinite(height_m); };
  found.require(std::none_of(heights_m.begin(), heights_m.end(), is_infinite),
                "a height of the grid is infinite");
  found.require(std::any_of(heights_m.begin(), heights_m.end(), is_known), "no height of the grid is known");
  return found.take();
}

HeightGrid::HeightGrid(const Layout& layout, std::vector<float> heights_m)
    : layout_(layout), heights_m_(std::move(heights_m)) {
  refuse_if_any(problems(layout_, heights_m_));
  least_m_ = std::numeric_limits<double>::infinity();
  greatest_m_ = -least_m_;
  for (const float height_m : heights_m_) {
    if (std::isnan(height_m)) continue;
    least_m_ = std::min<double>(least_m_, height_m);
    greatest_m_ = std::max<double>(greatest_m_, height_m);
  }
  const double middle_deg = 0.5 * (layout.south_deg + north_of(layout));
  spacing_m_ = std::min(layout.latitude_step_deg * kMetresPerDegree,
                        layout.longitude_step_deg * metres_per_degree_of_longitude(middle_deg));
}

std::optional<HeightGrid::Height> HeightGrid::at(const Geodetic& place) const {
  const double middle_deg = layout_.west_deg + 0.5 * width_deg(layout_);
  const double longitude_deg = middle_deg + std::remainder(place.longitude_deg - middle_deg, 360.0);
  const double row_steps = (place.latitude_deg - layout_.south_deg) / layout_.latitude_step_deg;
  const double column_steps = (longitude_deg - layout_.west_deg) / layout_.longitude_step_deg;
  if (!std::isfinite(row_steps) || !std::isfinite(column_steps)) return std::nullopt;
  const Span row = span_at(row_steps, layout_.rows), column = span_at(column_steps, layout_.columns);
  const auto across = [&](std::size_t r) {
    const double west = node_m(r, column.first), east = node_m(r, column.first + 1);
    return west + column.weight_of_second * (east - west);
  };
  const double south_m = across(row.first), north_m = across(row.first + 1);
  const double height_m = south_m + row.weight_of_second * (north_m - south_m);
  if (std::isnan(height_m)) return std::nullopt;
  const double beyond_north_m = row.beyond * layout_.latitude_step_deg * kMetresPerDegree;
  const double beyond_east_m =
      column.beyond * layout_.longitude_step_deg * metres_per_degree_of_longitude(place.latitude_deg);
  return Height{height_m, std::hypot(beyond_north_m, beyond_east_m)};
}

}  // namespace geoloc
