// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace geoloc {

/// How often the detector finds a confirmed object that a frame shows: it follows the light and the ground.
class DetectionRate {
 public:
  /// probability: before any look was counted.
  explicit DetectionRate(double probability)
      : hits_(probability * kPriorOpportunities), opportunities_(kPriorOpportunities) {}

  enum class Outcome { kFound, kMissed };

  void count(Outcome outcome) {
    opportunities_ += 1.0;
    hits_ += outcome == Outcome::kFound ? 1.0 : 0.0;
    if (opportunities_ > kMostOpportunities) {
      opportunities_ *= 0.5;
      hits_ *= 0.5;
    }
  }

  /// Never certain either way.
  double probability() const { return std::clamp(hits_ / opportunities_, 0.05, 0.98); }

 private:
  /// What the assumed probability counts for against observed looks.
  static constexpr double kPriorOpportunities = 20.0;
  /// Looks to remember.
  static constexpr double kMostOpportunities = 2000.0;

  double hits_;
  double opportunities_;
};

}  // namespace geoloc
