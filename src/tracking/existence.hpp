// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace geoloc {

/// Log-odds that an object exists, from the looks that found it and those that should have.
class Existence {
 public:
  explicit Existence(double birth_probability) : log_odds_(log_odds_of(birth_probability)) {}

  /// Found: where an object is, detections fall with `detection_probability` and the density `likelihood`
  /// [1/m^2]; where none is, with `clutter_density` [1/m^2].
  void hit(double detection_probability, double likelihood, double clutter_density) {
    add(std::log(detection_probability * likelihood / clutter_density));
  }

  /// Something else than looks tells that it is so many times as probable.
  void weigh(double likelihood_ratio) { add(std::log(likelihood_ratio)); }

  /// Not found, though it would have been with this probability.
  void miss(double detection_probability) { add(std::log(1.0 - detection_probability)); }

  /// Two tracks turned out to be one object: the better one's evidence stands.
  void merge(const Existence& other) { log_odds_ = std::max(log_odds_, other.log_odds_); }

  double probability() const { return 1.0 / (1.0 + std::exp(-log_odds_)); }

 private:
  /// Bounds what one look can say and how long a belief outlives its object.
  static constexpr double kMostPerLook = 6.0;
  static constexpr double kMost = 16.0;

  static double log_odds_of(double probability) { return std::log(probability / (1.0 - probability)); }
  void add(double evidence) {
    log_odds_ = std::clamp(log_odds_ + std::clamp(evidence, -kMostPerLook, kMostPerLook), -kMost, kMost);
  }

  double log_odds_;
};

}  // namespace geoloc
