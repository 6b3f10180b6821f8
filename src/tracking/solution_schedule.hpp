// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

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
    return is_requested_ || frames_ <= eager_until_ || !has_solution_ || now < solved_at_ ||
           seconds(now - solved_at_) >= period_s_;
  }

  void begin_solution(VehicleTime now) {
    has_solution_ = true;
    solved_at_ = now;
    is_requested_ = false;
  }

  /// Whether the wandering is to be learnt with the solution just found: with each until it has settled, then
  /// now and then, since it costs as much as a solution.
  bool next_solution_teaches_wandering() {
    const int pause = solutions_ < kSolutionsToSettle ? 1 : kSolutionsPerLessonLater;
    return ++solutions_ % pause == 0;
  }

 private:
  static constexpr int kEagerFrames = 100;
  static constexpr int kFramesAfterChange = 20;
  static constexpr int kSolutionsToSettle = 150;
  static constexpr int kSolutionsPerLessonLater = 5;

  double period_s_;
  bool has_solution_ = false;
  VehicleTime solved_at_{};
  bool is_requested_ = false;
  int frames_ = 0;
  int eager_until_ = kEagerFrames;
  int solutions_ = 0;
};

}  // namespace geoloc
