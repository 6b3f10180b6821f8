// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/arrowhead.hpp"
#include "calibration/shared_error_estimate.hpp"
#include "geometry/room.hpp"
#include "tracking/known_point_matcher.hpp"
#include "tracking/track_table.hpp"

namespace geoloc {

/// Which objects are surveyed, with what a solution knows of them.
class SurveyedObjects {
 public:
  explicit SurveyedObjects(int most_tracks) { take_room(this, most_tracks); }
  /// geometry/room.hpp
  static std::size_t take_room(SurveyedObjects* self, int most_tracks) {
    return room::reserve(self, &SurveyedObjects::candidates_, most_tracks);
  }

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
