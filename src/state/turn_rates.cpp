// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/turn_rates.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "geoloc/state/interpolation.hpp"
#include "state/turning.hpp"

namespace geoloc {
namespace {

/// Between samples farther apart, the rates at both ends say little of the turn.
constexpr Duration kLongestTurnPause = std::chrono::seconds{1};
constexpr int kTurnsRemembered = 1000;
/// A turn farther from what the rates make of it than noise explains was not told by them: a clock may have
/// stopped between the two samples.
constexpr double kMostSigmas = 6.0;

/// About the body's axes [rad].
Eigen::Vector3d turn_between(const EulerAngles& before, const EulerAngles& after) {
  return rotation_vector(ned_from_body(before).conjugate() * ned_from_body(after));
}

}  // namespace

void TurnRates::observe(const AttitudeSample& sample) {
  if (newest_ && sample.time <= newest_->time) return;
  const std::optional<AttitudeSample> before = std::exchange(newest_, sample);
  if (!before || !tells_rates(*before) || !tells_rates(sample)) return;
  const Duration pause = sample.time - before->time;
  if (pause > kLongestTurnPause) return;
  const Eigen::Vector3d by_attitudes = turn_between(before->angles, sample.angles);
  const Eigen::Vector3d by_rates =
      0.5 * seconds(pause) * (*before->rates_in_body_radps + *sample.rates_in_body_radps);
  by_rates_squared_ += by_rates.squaredNorm();
  product_ += by_rates.dot(by_attitudes);
  by_attitudes_squared_ += by_attitudes.squaredNorm();
  if (++turns_ < kTurnsRemembered) return;
  turns_ /= 2;
  by_rates_squared_ *= 0.5;
  product_ *= 0.5;
  by_attitudes_squared_ *= 0.5;
}

double TurnRates::slope() const {
  return product_ / by_rates_squared_;
}

double TurnRates::noise_squared() const {
  return (by_attitudes_squared_ - slope() * product_) / (3.0 * turns_);
}

bool TurnRates::are_believed() const {
  if (turns_ < 2 || !(by_rates_squared_ > 0.0)) return false;
  return std::abs(slope() - 1.0) < 0.5 && noise_squared() < 0.25 * 0.25 * by_rates_squared_;
}

Eigen::Vector3d TurnRates::between(const AttitudeSample& before, const AttitudeSample& after,
                                   double alpha) const {
  const double pause_s = seconds(after.time - before.time);
  const Eigen::Vector3d by_attitudes = turn_between(before.angles, after.angles) / pause_s;
  if (!are_believed() || !tells_rates(before) || !tells_rates(after)) return by_attitudes;
  const auto rates_at = [&](double share) {
    return Interpolator<Eigen::Vector3d>::between(*before.rates_in_body_radps, *after.rates_in_body_radps,
                                                  share);
  };
  const double unexplained_rad = pause_s * (by_attitudes - rates_at(0.5)).norm();
  return unexplained_rad * unexplained_rad < kMostSigmas * kMostSigmas * noise_squared() ? rates_at(alpha)
                                                                                         : by_attitudes;
}

}  // namespace geoloc
