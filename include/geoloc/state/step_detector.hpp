// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"

namespace geoloc {

/// What a quantity can do by itself.
struct StepLimits {
  double noise;                ///< what samples scatter by without being noticed
  double acceleration;         ///< the most that the vehicle does, per s^2
  double sigma;                ///< 1-sigma of a step's size,
  double share_of_size = 0.0;  ///< and in proportion to it: what jumps is seldom true right after
};

/// A sum of N components of steps, with their variances.
template <int N>
struct StepSum {
  using Vector = Eigen::Matrix<double, N, 1>;

  std::uint32_t count = 0;
  Vector size = Vector::Zero();
  Vector variance = Vector::Zero();
};

/// Notices where a quantity of N components steps: where a sample is farther from where the ones before let
/// expect it than any vehicle accelerates, and than samples usually are. What slow telemetry or lost packets
/// leave open is no step; what goes on at a new speed was motion, and so are steps without end.
template <int N>
class StepDetector {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  explicit StepDetector(const StepLimits& limits) : limits_(limits) {}

  /// The steps up to and with this sample, which must be later than those before.
  const StepSum<N>& observe(VehicleTime time, const Vector& value);

  const StepSum<N>& steps() const { return steps_; }

  /// What comes next does not go on from here; the steps so far count.
  void restart() {
    time_.reset();
    velocity_.reset();
    usual_ = 0.0;
    samples_ = 0;
    steps_in_a_row_ = 0;
  }

 private:
  /// What is expected, and how far from it a sample is no step.
  struct Expectation {
    Vector value;
    double most;
    double by_acceleration;  // of `most`
  };

  Expectation expect(double pause_s) const;
  bool is_motion_after_all(const Vector& size, double pause_s, double most) const;
  void take_step(const Vector& size, const Expectation& expected);
  void undo_step();
  void go_on(const Vector& value, double pause_s, double distance, double most);

  StepLimits limits_;
  std::optional<VehicleTime> time_;
  Vector value_ = Vector::Zero();
  std::optional<Vector> velocity_;  // per s, over pause_s_
  double pause_s_ = 0.0;
  double usual_ = 0.0;  // distance from what was expected
  int samples_ = 0;
  int steps_in_a_row_ = 0;
  Vector row_ = Vector::Zero();        // their sum
  Vector last_step_ = Vector::Zero();  // the last of them
  StepSum<N> steps_;
};

extern template class StepDetector<1>;
extern template class StepDetector<2>;

}  // namespace geoloc
