// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geoloc/io/detection/yolo_decode.hpp"
#include "rotated_box.hpp"

namespace geoloc::io {

/// The best class of each candidate. A score is NaN where any that it is made of is; a class is -1 where the
/// network names none of its own.
struct BestScores {
  std::vector<float> values;
  std::vector<int> class_ids;
};

BestScores best_scores(const YoloOutput& output);

/// A candidate's outline in pixels of the network's input; nullopt if it is impossible.
struct Outline {
  Box upright;                          ///< around it
  std::optional<RotatedBox> rotated{};  ///< where the network gives one
};

std::optional<Outline> outline_of(const YoloOutput& output, ImageSize input, int candidate);

}  // namespace geoloc::io
