// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace geoloc::apps {

/// Exponentially weighted mean over about the last ten values, for the status line.
class RunningMean {
 public:
  void add(double value) {
    mean_ = empty_ ? value : mean_ + kWeightOfNewest * (value - mean_);
    empty_ = false;
  }
  /// 0 before the first value.
  double value() const { return mean_; }

 private:
  static constexpr double kWeightOfNewest = 0.1;
  double mean_ = 0.0;
  bool empty_ = true;
};

}  // namespace geoloc::apps
