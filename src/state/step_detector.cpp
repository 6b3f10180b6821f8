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
    const double by_acceleration = 0.5 * limits_.acceleration * pause_s * (pause_s + pause_s_);
    const Vector size = value - value_ - pause_s * *velocity_;
    const double distance = size.norm();
    const double most = std::max(limits_.noise, kUnusualDistance * usual_) + by_acceleration;
    if (samples_ >= kSamplesToJudge && distance > most) {
      const double sigma = limits_.sigma + limits_.share_of_size * distance +
                           kUsualShareOfAcceleration * by_acceleration + usual_;
      ++steps_.count;
      steps_.size += size;
      steps_.variance.array() += sigma * sigma;
      row_ = steps_in_a_row_ > 0 ? Vector(row_ + size) : size;
      if (++steps_in_a_row_ >= kMostInARow) {
        velocity_.reset();
        steps_.variance.array() += row_.squaredNorm();
        steps_in_a_row_ = 0;
      }
    } else {
      constexpr double kSlowest = 0.05;
      const double gain = std::max(kSlowest, 1.0 / ++samples_);
      usual_ += gain * (std::min(distance, most) - usual_);
      velocity_ = (value - value_) / pause_s;
      steps_in_a_row_ = 0;
    }
  }
  time_ = time;
  value_ = value;
  pause_s_ = pause_s;
  return steps_;
}

template class StepDetector<1>;
template class StepDetector<2>;

}  // namespace geoloc
