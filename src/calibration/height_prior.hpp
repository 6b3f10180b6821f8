// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace geoloc {

/// What is believed of the height before anything is seen. Mostly it is right to a metre or two, but a
/// vehicle that took off elsewhere is off by tens: the tails are those of Student's distribution with one
/// degree of freedom, by iteratively reweighted least squares (Lange, Little and Taylor 1989).
struct HeightPrior {
  double mean_m = 0.0;   ///< of the camera above the level ground, against what is reported
  double sigma_m = 0.0;  ///< scale of the distribution; 0: the height is known

  /// 1-sigma of the Gaussian that stands for it where the height is estimated to be `height_m`.
  double sigma_at(double height_m) const {
    return std::sqrt(0.5 * (sigma_m * sigma_m + std::pow(sigma_m > 0.0 ? height_m - mean_m : 0.0, 2)));
  }
};

/// A vehicle that begins by reporting less than that above the level ground probably took off higher up.
inline constexpr double kUsualHeight_m = 10.0;

/// `prior`, once the first frame was taken where the vehicle reports to be so high above the level ground.
inline HeightPrior seen_from(double reported_height_above_ground_m, HeightPrior prior) {
  if (!(prior.sigma_m > 0.0)) return prior;
  const double missing_m = std::max(0.0, kUsualHeight_m - (reported_height_above_ground_m + prior.mean_m));
  prior.mean_m += missing_m;
  prior.sigma_m = std::max(prior.sigma_m, missing_m);
  return prior;
}

}  // namespace geoloc
