// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "tracking/joint_association.hpp"

namespace geoloc {

/// How many of the last frames' looks show a known object: while most do, calibration and clocks are right.
class ExplainedShare {
 public:
  void take(const std::vector<JointAssociation::Match>& match_of_look) {
    if (match_of_look.empty()) return;
    const auto known =
        std::count_if(match_of_look.begin(), match_of_look.end(),
                      [](const JointAssociation::Match& match) { return match.track.has_value(); });
    const double share = static_cast<double>(known) / static_cast<double>(match_of_look.size());
    value_ += kWeight * (share - value_);
  }

  double value() const { return value_; }

 private:
  static constexpr double kWeight = 0.2;  ///< of the newest frame
  double value_ = 1.0;
};

}  // namespace geoloc
