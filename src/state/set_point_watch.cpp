// SPDX-License-Identifier: Apache-2.0
#include "geoloc/state/set_point_watch.hpp"

#include <cmath>

#include "state/turning.hpp"

namespace geoloc {
namespace {

/// Ten seconds at the usual 10 Hz.
constexpr int kSamples = 100;
constexpr int kEvenOfSetPoint = 95, kEvenOfMeasurement = 80;
/// The way that roll and pitch of a vehicle in flight go in that time, at least: on the ground nothing moves.
constexpr double kShaken_rad = 5.0 * kRadPerDeg;
/// Second differences of the turn from sample to sample: of single precision, and of a smooth motion.
constexpr double kEven_rad = 0.003 * kRadPerDeg, kEvenShare = 0.02;

}  // namespace

void SetPointWatch::observe(const Eigen::Quaterniond& level_from_gimbal) {
  if (!last_) {
    last_ = level_from_gimbal;
    return;
  }
  const Eigen::Vector2d tilt = rotation_vector(level_from_gimbal * last_->conjugate()).head<2>();
  if (is_even(tilt)) ++even_samples_;
  last_ = level_from_gimbal;
  tilt_before_ = tilt_;
  tilt_ = tilt;
  if (++samples_ == kSamples) judge();
}

bool SetPointWatch::is_even(const Eigen::Vector2d& tilt) const {
  return (tilt - 2.0 * tilt_ + tilt_before_).norm() < kEven_rad + kEvenShare * tilt.norm();
}

void SetPointWatch::note_vehicle(const EulerAngles& angles) {
  if (vehicle_)
    vehicle_shaken_rad_ += std::abs(wrap_to_pi(angles.roll_rad - vehicle_->roll_rad)) +
                           std::abs(angles.pitch_rad - vehicle_->pitch_rad);
  vehicle_ = angles;
}

void SetPointWatch::judge() {
  if (even_samples_ < kEvenOfMeasurement) is_set_point_ = false;
  if (even_samples_ >= kEvenOfSetPoint && vehicle_shaken_rad_ >= kShaken_rad) is_set_point_ = true;
  samples_ = even_samples_ = 0;
  vehicle_shaken_rad_ = 0.0;
}

void SetPointWatch::restart() {
  last_.reset();
  vehicle_.reset();
  tilt_before_ = tilt_ = Eigen::Vector2d::Zero();
  vehicle_shaken_rad_ = 0.0;
  samples_ = even_samples_ = 0;
}

}  // namespace geoloc
