// SPDX-License-Identifier: Apache-2.0
#include "eval/axis_scale.hpp"

namespace geoloc::apps {
namespace {

constexpr double kBorder = 0.05;  // of the length
constexpr double kLeastTicks = 6.0;

/// For about six ticks.
double round_step(double length) {
  const double rough = length / kLeastTicks;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (rough <= digit * decade) return digit * decade;
  }
  return 10.0 * decade;
}

}  // namespace

AxisScale::AxisScale(const ChartAxis& axis, ValueRange range, double from_px, double to_px)
    : is_logarithmic_(axis.is_logarithmic), from_px_(from_px), to_px_(to_px) {
  for (const double tick : axis.ticks) range.add(tick);
  if (range.is_empty()) range = {1.0, 2.0};
  low_ = along(range.low);
  high_ = along(range.high);
  const double alone = is_logarithmic_ || low_ == 0.0 ? 0.5 : 0.5 * std::abs(low_);  // of a single value
  const double border = high_ > low_ ? kBorder * (high_ - low_) : alone;
  low_ -= border;
  high_ += border;
  ticks_ = axis.ticks.empty() ? round_ticks() : axis.ticks;
}

std::vector<double> AxisScale::round_ticks() const {
  std::vector<double> ticks;
  const auto add = [&](double tick) {
    if (along(tick) >= low_ && along(tick) <= high_) ticks.push_back(tick);
  };
  if (is_logarithmic_) {
    for (double decade = std::floor(low_); decade <= high_; decade += 1.0) {
      for (const double digit : {1.0, 2.0, 5.0}) add(digit * std::pow(10.0, decade));
    }
  } else {
    const double step = round_step(high_ - low_);
    const double first = std::ceil(low_ / step);
    for (int i = 0; i <= static_cast<int>(kLeastTicks); ++i) add((first + i) * step);
  }
  return ticks;
}

}  // namespace geoloc::apps
