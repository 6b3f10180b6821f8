// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/step_detector.hpp"

#include <algorithm>
#include <cmath>

namespace geoloc {
namespace {

/// So many samples tell what is usual.
constexpr int kSamplesToJudge = 5;
/// A velocity from before a longer pause predicts nothing.
constexpr double kLongestPause_s = 3.0;
/// A hard manoeuvre may be so many times what is expected of vehicles.
constexpr double kViolent = 3.0;
/// A filter that is drawn to a new place takes some samples; a longer row of steps is motion after all.
constexpr int kMostInARow = 8;
/// How well a step's size is known, as a share of the most that acceleration may have added to it.
constexpr double kUsualShareOfAcceleration = 0.25;

}  // namespace

template <int N>
const StepSum<N>& StepDetector<N>::observe(VehicleTime time, const Vector& value,
                                           const std::optional<Vector>& rate) {
  const double pause_s = time_ ? seconds(time - *time_) : 0.0;
  if (!time_ || pause_s > kLongestPause_s) {
    velocity_.reset();
  } else if (!velocity_) {
    velocity_ = (value - value_) / pause_s;
  } else {
    judge(value, rate, pause_s);
  }
  time_ = time;
  value_ = value;
  rate_ = rate;
  pause_s_ = pause_s;
  return steps_;
}

template <int N>
void StepDetector<N>::judge(const Vector& value, const std::optional<Vector>& rate, double pause_s) {
  const Expectation by_velocity = expect(pause_s);
  const auto by_rate = rate && rate_ ? std::optional(expect_by_rate(*rate, pause_s)) : std::nullopt;
  const bool is_told = by_rate && trust_.is_earned();
  const Expectation& expected = is_told ? *by_rate : by_velocity;
  const bool is_expected =
      usual_.samples() < kSamplesToJudge || expected.fits(value) || (by_rate && by_rate->fits(value));
  const Vector size = value - expected.value;
  const bool is_motion = !is_expected && is_motion_after_all(size, pause_s, expected.most);
  if (is_motion) undo_step();
  if (!is_expected && !is_motion) return take_step(size, expected);
  usual_.learn(by_velocity.distance(value), by_velocity.most);
  if (by_rate) learn_rate(value, *by_rate);
  velocity_ = (value - value_) / pause_s;
  steps_in_a_row_ = 0;
}

template <int N>
typename StepDetector<N>::Expectation StepDetector<N>::expect(double pause_s) const {
  const double by_acceleration = 0.5 * limits_.acceleration * pause_s * (pause_s + pause_s_);
  const double by_noise = std::max(limits_.noise, usual_.most());
  return {value_ + pause_s * *velocity_, by_noise + by_acceleration, by_acceleration, usual_.mean()};
}

/// From one rate to the other, at the latest or at the earliest, and a swing between the samples.
template <int N>
typename StepDetector<N>::Expectation StepDetector<N>::expect_by_rate(const Vector& rate,
                                                                      double pause_s) const {
  const double by_change = 0.5 * pause_s * (rate - *rate_).norm();
  const double by_acceleration = by_change + 0.25 * limits_.swing * pause_s * pause_s;
  const double usual = trust_.is_earned() ? usual_by_rate_.most() : 0.0;
  return {value_ + 0.5 * pause_s * (*rate_ + rate), std::max(limits_.noise, usual + by_acceleration),
          by_acceleration, usual_by_rate_.mean()};
}

/// After a first step, a second one of the same speed that is not far beyond what vehicles do.
template <int N>
bool StepDetector<N>::is_motion_after_all(const Vector& size, double pause_s, double most) const {
  if (steps_in_a_row_ != 1 || size.norm() > kViolent * most) return false;
  return (size - pause_s / pause_s_ * last_step_).norm() <= most;
}

template <int N>
void StepDetector<N>::take_step(const Vector& size, const Expectation& expected) {
  const double sigma = limits_.sigma + limits_.share_of_size * size.norm() +
                       kUsualShareOfAcceleration * expected.by_acceleration + expected.usual;
  ++steps_.count;
  steps_.size += size;
  steps_.variance.array() += sigma * sigma;
  last_step_ = size;
  row_ = steps_in_a_row_ > 0 ? Vector(row_ + size) : size;
  if (++steps_in_a_row_ < kMostInARow) return;
  velocity_.reset();
  steps_.variance.array() += row_.squaredNorm();
  steps_in_a_row_ = 0;
}

/// The sample before stays a step from the ones before it, and this one is a step back.
template <int N>
void StepDetector<N>::undo_step() {
  ++steps_.count;
  steps_.size -= last_step_;
}

template <int N>
void StepDetector<N>::learn_rate(const Vector& value, const Expectation& by_rate) {
  usual_by_rate_.learn(by_rate.distance(value), by_rate.most);
  trust_.learn((value - value_).norm(), by_rate.distance(value));
}

template class StepDetector<1>;
template class StepDetector<2>;

}  // namespace geoloc
