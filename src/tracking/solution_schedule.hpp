// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "geoloc/geometry/time.hpp"

namespace geoloc {

/// When the head is solved: after each frame at the start of a flight, since it learns most then, later once
/// a period, and as soon as two tracks may turn out to be one.
class SolutionSchedule {
 public:
  explicit SolutionSchedule(double period_s) : period_s_(period_s) {}

  void count_frame() { ++frames_; }
  void request() { is_requested_ = true; }

  /// Something has changed that the next frames will tell.
  void request_for_some_frames() { eager_until_ = std::max(eager_until_, frames_ + kFramesAfterChange); }

  bool is_due(VehicleTime now) const {
    return is_requested_ || frames_ <= eager_until_ || solutions_ == 0 || now < solved_at_ ||
           seconds(now - solved_at_) >= period_s_;
  }

  void begin_solution(VehicleTime now) {
    ++solutions_;
    solved_at_ = now;
    is_requested_ = false;
  }

  /// Whether the wandering is to be learnt with the present one: with each until it has settled, then now and
  /// then, since it costs as much as a solution.
  bool teaches_wandering() const {
    return solutions_ <= kSolutionsToSettle || solutions_ % kSolutionsPerLessonLater == 0;
  }

 private:
  static constexpr int kEagerFrames = 100;
  static constexpr int kFramesAfterChange = 20;
  static constexpr std::uint64_t kSolutionsToSettle = 150;
  static constexpr std::uint64_t kSolutionsPerLessonLater = 5;

  double period_s_;
  VehicleTime solved_at_{};
  bool is_requested_ = false;
  int frames_ = 0;
  int eager_until_ = kEagerFrames;
  std::uint64_t solutions_ = 0;
};

}  // namespace geoloc
