// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geoloc/state/samples.hpp"

namespace geoloc {

/// How fast a vehicle turns between two attitudes: by the rates that are told with them, once these have
/// proved right, since the difference of two attitudes is as noisy as they are. What a late frame is off by
/// would be looked for in that noise, and not be found (errors in variables).
class TurnRates {
 public:
  /// A sample later than those before; others tell nothing new.
  void observe(const AttitudeSample& sample);

  /// What comes next does not go on from here.
  void restart() { newest_.reset(); }

  /// About the body's axes [rad/s], a share `alpha` of the way from one sample to a later one.
  Eigen::Vector3d between(const AttitudeSample& before, const AttitudeSample& after, double alpha) const;

  /// Whether the rates are believed: some senders leave them 0, or tell them in other units. Turns from one
  /// attitude to the next may be mostly noise; their slope over what the rates make of them is right all the
  /// same. It is to be 1 to a half, and known to a quarter (1 sigma).
  bool are_believed() const;

 private:
  /// The slope of the turns that the attitudes tell over those that the rates tell.
  double slope() const;
  /// Variance of what the slope does not explain, per axis [rad^2].
  double noise_squared() const;

  std::optional<AttitudeSample> newest_;
  // Sums of squares and products of turns, as told by the attitudes and by the rates [rad^2].
  double by_rates_squared_ = 0.0, product_ = 0.0, by_attitudes_squared_ = 0.0;
  int turns_ = 0;
};

}  // namespace geoloc
