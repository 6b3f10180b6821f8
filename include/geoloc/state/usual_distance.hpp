// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace geoloc {

/// How far samples usually are from what was expected of them, in the mean of the last twenty or so.
class UsualDistance {
 public:
  /// One that is farther than `most` counts as that far: an exception shall not become usual.
  void learn(double distance, double most) {
    constexpr double kSlowest = 0.05;
    ++samples_;
    mean_ += std::max(kSlowest, 1.0 / samples_) * (std::min(distance, most) - mean_);
  }

  double mean() const { return mean_; }
  int samples() const { return samples_; }

  /// What is farther is unusual.
  double most() const {
    constexpr double kUnusual = 6.0;
    return kUnusual * mean_;
  }

 private:
  double mean_ = 0.0;
  int samples_ = 0;
};

}  // namespace geoloc
