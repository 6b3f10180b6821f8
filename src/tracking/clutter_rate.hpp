// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace geoloc {

/// How many false boxes the detector makes per frame: looks of tracks that were given up before they were
/// confirmed. It follows the ground, like the detection rate.
class ClutterRate {
 public:
  /// per_frame: before any was counted.
  explicit ClutterRate(double per_frame)
      : assumed_per_frame_(per_frame), boxes_(per_frame * kPriorFrames), frames_(kPriorFrames) {}

  void count_frame() {
    frames_ += 1.0;
    if (frames_ < kMostFrames) return;
    frames_ *= 0.5;
    boxes_ *= 0.5;
  }

  void count_false(int boxes) { boxes_ += boxes; }

  double per_frame() const { return boxes_ / frames_; }

  /// Probability that a look which shows no known object shows a new one, where it is `usual` at the rate
  /// assumed: of more false boxes, fewer do.
  double birth_probability(double usual) const {
    const double odds = usual / (1.0 - usual) * std::min(1.0, assumed_per_frame_ / per_frame());
    return odds / (1.0 + odds);
  }

 private:
  /// What the assumed rate counts for against observed frames.
  static constexpr double kPriorFrames = 50.0;
  /// Frames to remember.
  static constexpr double kMostFrames = 1000.0;

  double assumed_per_frame_;
  double boxes_;
  double frames_;
};

}  // namespace geoloc
