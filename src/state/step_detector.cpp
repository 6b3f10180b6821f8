// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/step_detector.hpp"

#include <algorithm>
#include <cmath>

namespace geoloc {
namespace {

/// What lies farther than so many times the usual distance is a step.
constexpr double kUnusualDistance = 6.0;
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
const StepSum<N>& StepDetector<N>::observe(VehicleTime time, const Vector& value) {
  const double pause_s = time_ ? seconds(time - *time_) : 0.0;
  if (!time_ || pause_s > kLongestPause_s) {
    velocity_.reset();
  } else if (!velocity_) {
    velocity_ = (value - value_) / pause_s;
  } else {
    const Expectation expected = expect(pause_s);
    const Vector size = value - expected.value;
    const bool is_expected = samples_ < kSamplesToJudge || size.norm() <= expected.most;
    const bool is_motion = !is_expected && is_motion_after_all(size, pause_s, expected.most);
    if (is_motion) undo_step();
    if (is_expected || is_motion) {
      go_on(value, pause_s, size.norm(), expected.most);
    } else {
      take_step(size, expected);
    }
  }
  time_ = time;
  value_ = value;
  pause_s_ = pause_s;
  return steps_;
}

template <int N>
typename StepDetector<N>::Expectation StepDetector<N>::expect(double pause_s) const {
  const double by_acceleration = 0.5 * limits_.acceleration * pause_s * (pause_s + pause_s_);
  const double by_noise = std::max(limits_.noise, kUnusualDistance * usual_);
  return {value_ + pause_s * *velocity_, by_noise + by_acceleration, by_acceleration};
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
                       kUsualShareOfAcceleration * expected.by_acceleration + usual_;
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
void StepDetector<N>::go_on(const Vector& value, double pause_s, double distance, double most) {
  constexpr double kSlowest = 0.05;
  const double gain = std::max(kSlowest, 1.0 / ++samples_);
  usual_ += gain * (std::min(distance, most) - usual_);
  velocity_ = (value - value_) / pause_s;
  steps_in_a_row_ = 0;
}

template class StepDetector<1>;
template class StepDetector<2>;

}  // namespace geoloc
