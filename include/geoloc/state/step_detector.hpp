// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "geoloc/geometry/time.hpp"
#include "geoloc/state/rate_trust.hpp"
#include "geoloc/state/usual_distance.hpp"

namespace geoloc {

/// What a quantity can do by itself.
struct StepLimits {
  double noise;                ///< what samples scatter by without being noticed
  double acceleration;         ///< the most that the vehicle does, per s^2
  double swing;                ///< the same, to and fro between two samples whose rates are told
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
///
/// Samples that tell their rates tell motion from steps: what agrees with its own rates was moved, however
/// fast. Once rates have proved to be true, what disagrees with them has stepped, also where slow telemetry
/// leaves time to have moved there.
template <int N>
class StepDetector {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  explicit StepDetector(const StepLimits& limits) : limits_(limits) {}

  /// The steps up to and with this sample, which must be later than those before. `rate`: what the sample
  /// tells of its change per s.
  const StepSum<N>& observe(VehicleTime time, const Vector& value,
                            const std::optional<Vector>& rate = std::nullopt);

  const StepSum<N>& steps() const { return steps_; }

  /// What comes next does not go on from here; the steps so far count.
  void restart() {
    time_.reset();
    rate_.reset();
    velocity_.reset();
    usual_ = {};
    usual_by_rate_ = {};
    trust_ = {};
    steps_in_a_row_ = 0;
  }

 private:
  /// What is expected, and how far from it a sample is no step.
  struct Expectation {
    Vector value;
    double most;
    double by_acceleration;  // of `most`
    double usual;            // distance

    double distance(const Vector& now) const { return (now - value).norm(); }
    bool fits(const Vector& now) const { return distance(now) <= most; }
  };

  void judge(const Vector& value, const std::optional<Vector>& rate, double pause_s);
  Expectation expect(double pause_s) const;
  Expectation expect_by_rate(const Vector& rate, double pause_s) const;
  bool is_motion_after_all(const Vector& size, double pause_s, double most) const;
  void take_step(const Vector& size, const Expectation& expected);
  void undo_step();
  void learn_rate(const Vector& value, const Expectation& by_rate);

  StepLimits limits_;
  std::optional<VehicleTime> time_;
  Vector value_ = Vector::Zero();
  std::optional<Vector> rate_;      // per s, as told with value_
  std::optional<Vector> velocity_;  // per s, over pause_s_
  double pause_s_ = 0.0;
  UsualDistance usual_;
  UsualDistance usual_by_rate_;
  RateTrust trust_;
  int steps_in_a_row_ = 0;
  Vector row_ = Vector::Zero();        // their sum
  Vector last_step_ = Vector::Zero();  // the last of them
  StepSum<N> steps_;
};

extern template class StepDetector<1>;
extern template class StepDetector<2>;

}  // namespace geoloc
