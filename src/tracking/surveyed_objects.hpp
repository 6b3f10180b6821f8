// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "calibration/arrowhead.hpp"
#include "calibration/shared_error_estimate.hpp"
#include "tracking/known_point_matcher.hpp"
#include "tracking/track_table.hpp"

namespace geoloc {

/// Which objects are surveyed, with what a solution knows of them.
class SurveyedObjects {
 public:
  explicit SurveyedObjects(int most_tracks) { candidates_.reserve(most_tracks); }

  /// A surveyed object's coordinates are information on its position, and through the head on all others'.
  /// True where there is some that the solution does not have. `accuracy`: of the vehicle's position. gate,
  /// ambiguity: as KnownPointMatcher::match().
  bool match(const ArrowheadSolver::Solution& solution, const PositionAccuracy& accuracy, double gate,
             double ambiguity, KnownPointMatcher& points, TrackTable& tracks);

 private:
  double list_candidates(const ArrowheadSolver::Solution& solution, const TrackTable& tracks);

  std::vector<KnownPointMatcher::Candidate> candidates_;  // scratch
};

}  // namespace geoloc
