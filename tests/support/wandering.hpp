// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "geoloc/calibration/drift_config.hpp"

namespace geoloc::testing {

/// What a receiver's position is off by, as the drift's prior expects: wandering and ripple, each a
/// stationary first-order Gauss-Markov process, drawn at equal steps.
class WanderingPosition {
 public:
  /// sigma_m: of east and of north, both processes together.
  WanderingPosition(const DriftConfig& drift, double sigma_m, double step_s)
      : wandering_(std::sqrt(1.0 - drift.ripple_share) * sigma_m, drift.position_time_constant_s, step_s),
        ripple_(std::sqrt(drift.ripple_share) * sigma_m, drift.ripple_time_constant_s, step_s) {}

  template <typename Random>
  Eigen::Vector2d next(Random& random) {
    return wandering_.next(random) + ripple_.next(random);
  }

 private:
  class Process {
   public:
    Process(double sigma_m, double time_constant_s, double step_s)
        : sigma_m_(sigma_m), kept_(std::exp(-step_s / time_constant_s)) {}

    template <typename Random>
    const Eigen::Vector2d& next(Random& random) {
      const double east = normal_(random), north = normal_(random);
      const double fresh = has_begun_ ? std::sqrt(1.0 - kept_ * kept_) : 1.0;
      now_ = kept_ * now_ + fresh * sigma_m_ * Eigen::Vector2d(east, north);
      has_begun_ = true;
      return now_;
    }

   private:
    double sigma_m_;
    double kept_;
    bool has_begun_ = false;
    Eigen::Vector2d now_ = Eigen::Vector2d::Zero();
    std::normal_distribution<double> normal_;
  };

  Process wandering_;
  Process ripple_;
};

}  // namespace geoloc::testing
