// SPDX-License-Identifier: Apache-2.0
#include "tracking/surveyed_objects.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace geoloc {
namespace {

/// An object with this share of the most looks is known about as well.
constexpr double kEnoughLooks = 0.5;
/// What one object is off by, of the trace of the difference's covariance: half of it per axis, of that half
/// for each of the two, and a fifth more, since differences have somewhat heavier tails than they should.
constexpr double kShareOfOne = 0.3;

/// What all objects share varies by so much of what they do not, at least: a receiver that jumps once in a
/// flight is not rare.
constexpr double kLeastShared = 4.0;

const RestingObject* most_seen(const TrackTable& tracks) {
  const RestingObject* most = nullptr;
  for (const RestingObject& object : tracks) {
    if (most == nullptr || object.track.hits > most->track.hits) most = &object;
  }
  return most;
}

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

}  // namespace

/// Returns the variance per axis that they share in the mean, and a part of their own [m^2].
double SurveyedObjects::list_candidates(const ArrowheadSolver::Solution& solution, const TrackTable& tracks) {
  candidates_.clear();
  const SurveyReferences references(tracks);
  double variance = 0.0, own_variance = 0.0;  // sums
  for (const RestingObject& object : tracks) {
    const Track& track = object.track;
    if (track.hits < kHitsToCompare) continue;
    const double own_m2 = references.own_variance_m2(object, solution);
    variance += 0.5 * track.position_in_enu.covariance.trace();
    own_variance += own_m2;
    candidates_.push_back(
        {track.id, object.is_confirmed(), track.class_id(), track.position_in_enu.mean, std::sqrt(own_m2)});
  }
  if (candidates_.empty()) return 0.0;
  return std::max(kLeastShared * own_variance, variance - own_variance) /
         static_cast<double>(candidates_.size());
}

/// The first point tells what the position is off by, and for it that is taken to be no less than the
/// receiver states: that its error wanders little does not show how large it is.
bool SurveyedObjects::match(const ArrowheadSolver::Solution& solution, const PositionAccuracy& accuracy,
                            double gate, double ambiguity, KnownPointMatcher& points, TrackTable& tracks) {
  if (points.is_empty()) return false;
  double shared_variance = list_candidates(solution, tracks);
  if (candidates_.empty()) return false;
  if (!points.has_matched())
    shared_variance = std::max(shared_variance, 0.5 * std::pow(accuracy.changing_m(), 2));
  if (!points.match(candidates_, std::sqrt(shared_variance), gate, ambiguity)) return false;
  for (RestingObject& object : tracks) {
    const auto survey = points.survey_of(object.track.id);
    if (!survey || object.is_known) continue;
    add_prior(object, survey->information());
    object.is_known = true;
  }
  return true;
}

}  // namespace geoloc
