// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geoloc/io/recording/recording.hpp"
#include "geoloc/io/stills/labels.hpp"

namespace geoloc::apps {

/// So that a replay scores itself. Heights only count where they have the datum of the pictures.
inline std::vector<io::TrueTarget> true_targets(const std::vector<io::SurveyedMark>& marks) {
  std::vector<io::TrueTarget> targets;
  for (const io::SurveyedMark& mark : marks) {
    io::TrueTarget target;
    target.id = static_cast<int>(targets.size());
    if (!mark.name.empty()) target.id = mark.name;
    target.position = mark.position;
    targets.push_back(target);
  }
  return targets;
}

}  // namespace geoloc::apps
