// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "eval/chart.hpp"

namespace geoloc::apps {

struct ValueRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool is_empty() const { return !(low <= high); }
};

/// Values to pixels along one axis of a drawing, with a border on both sides.
class AxisScale {
 public:
  /// The range must be above zero where the axis is logarithmic; any is taken for an empty one.
  AxisScale(const ChartAxis& axis, ValueRange range, double from_px, double to_px);

  double px(double value) const {
    return from_px_ + (along(value) - low_) / (high_ - low_) * (to_px_ - from_px_);
  }
  bool holds(double value) const { return std::isfinite(value) && (!is_logarithmic_ || value > 0.0); }
  double low() const { return is_logarithmic_ ? std::pow(10.0, low_) : low_; }
  double high() const { return is_logarithmic_ ? std::pow(10.0, high_) : high_; }

  /// Those of the axis, else round numbers: 1, 2, 5 times powers of ten.
  const std::vector<double>& ticks() const { return ticks_; }

 private:
  double along(double value) const { return is_logarithmic_ ? std::log10(value) : value; }
  std::vector<double> round_ticks() const;

  bool is_logarithmic_;
  double from_px_, to_px_;
  double low_ = 0.0, high_ = 1.0;  // decades where logarithmic
  std::vector<double> ticks_;
};

}  // namespace geoloc::apps
