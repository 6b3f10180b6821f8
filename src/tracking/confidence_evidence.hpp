// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace geoloc {

/// How often a detector was how confident, in steps of a twentieth.
struct ConfidenceCounts {
  static constexpr std::size_t kSteps = 20;
  std::array<double, kSteps> of_step{};
  double total = 0.0;

  static std::size_t step_of(double confidence) {
    return static_cast<std::size_t>(std::clamp(confidence * kSteps, 0.0, kSteps - 1.0));
  }
  void add(double confidence) {
    of_step[step_of(confidence)] += 1.0;
    total += 1.0;
  }
  void add(const ConfidenceCounts& other) {
    for (std::size_t step = 0; step < kSteps; ++step) of_step[step] += other.of_step[step];
    total += other.total;
  }
  void halve() {
    for (double& count : of_step) count *= 0.5;
    total *= 0.5;
  }
};

/// What a detector's confidence in a box says of whether the box shows an object: how much more often it was
/// that confident of confirmed objects than of what came to nothing. What was seen of either counts against
/// so many boxes of both together, so that few boxes say little, and boxes that are all alike say nothing.
class ConfidenceEvidence {
 public:
  void count_object(double confidence) {
    objects_.add(confidence);
    forget(objects_);
  }
  void count_false(const ConfidenceCounts& boxes) {
    false_.add(boxes);
    forget(false_);
  }

  /// p(confidence | object) / p(confidence | nothing); 1 of one never seen.
  double ratio(double confidence) const {
    const std::size_t step = ConfidenceCounts::step_of(confidence);
    const double all = objects_.of_step[step] + false_.of_step[step];
    if (!(all > 0.0)) return 1.0;
    const double usual = all / (objects_.total + false_.total);
    const auto share = [&](const ConfidenceCounts& boxes) {
      return (boxes.of_step[step] + kPriorBoxes * usual) / (boxes.total + kPriorBoxes);
    };
    return share(objects_) / share(false_);
  }

 private:
  static constexpr double kPriorBoxes = 20.0;
  /// Boxes to remember.
  static constexpr double kMostBoxes = 2000.0;

  static void forget(ConfidenceCounts& boxes) {
    if (boxes.total > kMostBoxes) boxes.halve();
  }

  ConfidenceCounts objects_;
  ConfidenceCounts false_;
};

}  // namespace geoloc
