// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "calibration/arrowhead.hpp"
#include "tracking/resting_object.hpp"
#include "tracking/track_table.hpp"

namespace geoloc {

/// Two objects, the best known and the one farthest from it that is known about as well. What another object
/// is off by besides what all are off by is how little is known of its difference to these: objects seen at
/// the same time share more than that, so that one reference would flatter its neighbours.
class SurveyReferences {
 public:
  explicit SurveyReferences(const TrackTable& tracks);

  /// Variance per axis [m^2]: by the reference from which the object differs by more.
  double own_variance_m2(const RestingObject& object, const ArrowheadSolver::Solution& solution) const;

 private:
  std::array<const RestingObject*, 2> references_{};
};

}  // namespace geoloc
