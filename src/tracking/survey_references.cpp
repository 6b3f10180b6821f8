// SPDX-License-Identifier: Apache-2.0
#include "tracking/survey_references.hpp"

#include <algorithm>

namespace geoloc {
namespace {

/// An object with this share of the most looks is known about as well.
constexpr double kEnoughLooks = 0.5;
/// What one object is off by, of the trace of the difference's covariance: half of it per axis, of that half
/// for each of the two, and a fifth more, since differences have somewhat heavier tails than they should.
constexpr double kShareOfOne = 0.3;

const RestingObject* most_seen(const TrackTable& tracks) {
  const RestingObject* most = nullptr;
  for (const RestingObject& object : tracks) {
    if (most == nullptr || object.track.hits > most->track.hits) most = &object;
  }
  return most;
}

}  // namespace

SurveyReferences::SurveyReferences(const TrackTable& tracks) {
  const RestingObject* const best = most_seen(tracks);
  if (best == nullptr) return;
  references_.fill(best);
  double farthest_m = 0.0;
  for (const RestingObject& object : tracks) {
    if (object.track.hits < kEnoughLooks * best->track.hits) continue;
    const double distance_m = (object.position_in_enu - best->position_in_enu).head<2>().norm();
    if (distance_m <= farthest_m) continue;
    farthest_m = distance_m;
    references_[1] = &object;
  }
}

double SurveyReferences::own_variance_m2(const RestingObject& object,
                                         const ArrowheadSolver::Solution& solution) const {
  double variance_m2 = 0.5 * object.own_covariance.topLeftCorner<2, 2>().trace();
  for (const RestingObject* const reference : references_) {
    if (reference == &object) continue;
    const PointMatrix covariance = solution.covariance_of_difference(*object.landmark, *reference->landmark);
    variance_m2 = std::max(variance_m2, kShareOfOne * covariance.topLeftCorner<2, 2>().trace());
  }
  return variance_m2;
}

}  // namespace geoloc
