// SPDX-License-Identifier: Apache-2.0
#include "tracking/identity.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "tracking/gaussian.hpp"

namespace geoloc {
namespace {

/// What two tracks of one object may differ by beyond their stated noise: its looks differ with the
/// direction.
constexpr double kSigmaSameObject_m = 0.15;
/// Their heights also by what the height drifted until the vehicle came back.
constexpr double kSigmaSameHeight_m = 0.5;
/// Looks beside a younger neighbour that may show that a track was made of looks at both, how far they must
/// be off together (chi-square, 2 degrees of freedom, 99.9 %), and how near to the line away from it.
constexpr int kLooksToSplit = 5;
constexpr double kSplitGate = 13.8;
constexpr double kSplitCosine = 0.7;
constexpr double kLeastSplit_m = 0.1;  // a box's centre is not the same point of an object from everywhere

Eigen::Vector2d apart(const RestingObject& a, const RestingObject& b) {
  return a.track.position_in_enu.mean - b.track.position_in_enu.mean;
}

/// Whether the looks that came beside a younger neighbour are drawn away from it by more than noise does.
bool is_drawn_aside(const RestingObject& object, const RestingObject& younger) {
  const Mixture& mixture = object.mixture;
  if (mixture.looks < kLooksToSplit) return false;
  const Eigen::Vector2d mean = mixture.sum_of_innovations / mixture.looks;
  const double noise = mixture.sum_of_noise / (mixture.looks * mixture.looks);
  if (mean.squaredNorm() < kSplitGate * noise + kLeastSplit_m * kLeastSplit_m) return false;
  const Eigen::Vector2d away = apart(object, younger);
  return mean.dot(away) > kSplitCosine * mean.norm() * away.norm();
}

void split_if_mixed(RestingObject& object, const RestingObject& younger, const Look& look,
                    const JointAssociation::Match& match, const SharedErrorEstimate& errors,
                    SettledSums& settled) {
  if (!match.track || object.is_known) return;
  ++object.mixture.looks;
  object.mixture.sum_of_innovations += match.innovation;
  object.mixture.sum_of_noise += look.pixel_noise.trace();
  if (!is_drawn_aside(object, younger)) return;
  leave_settled(object, settled);
  begin_sums(object, look, errors);
}

}  // namespace

bool are_not_told_apart(const RestingObject& a, const RestingObject& b, double merge_radius_m) {
  return apart(a, b).squaredNorm() <= merge_radius_m * merge_radius_m && !a.neighbours.are_apart(b.track.id);
}

/// The tracks' own noise is that of association: the sums count the noise of each frame as often as frames
/// repeat it, which is too much for tracks that the same frames made.
PointMatrix covariance_of_difference(const RestingObject& a, const RestingObject& b,
                                     const ArrowheadSolver::Solution& solution, const FrameNoise& noise) {
  const double fresh = 1.0 - noise.common_share(a.last_look - b.last_look);
  const double shares = noise.share_in_track(a.track.hits) + noise.share_in_track(b.track.hits);
  const Point same_object_m(kSigmaSameObject_m, kSigmaSameObject_m, kSigmaSameHeight_m);
  PointMatrix covariance = solution.covariance_of_difference(*a.landmark, *b.landmark) - a.own_covariance -
                           b.own_covariance + a.pixel_covariance + b.pixel_covariance;
  covariance.diagonal() += 2.0 * same_object_m.cwiseAbs2();
  covariance.topLeftCorner<2, 2>() += fresh * shares * noise.covariance;
  return covariance;
}

bool may_be_one(const RestingObject& a, const RestingObject& b, const ArrowheadSolver::Solution& solution,
                const FrameNoise& noise, const JointTrackerConfig& config) {
  return are_not_told_apart(a, b, config.merge_radius_m) && !(a.is_known && b.is_known) &&
         std::min(a.track.hits, b.track.hits) >= kHitsToCompare &&
         mahalanobis_squared(Eigen::Vector3d(a.position_in_enu - b.position_in_enu),
                             covariance_of_difference(a, b, solution, noise)) <= config.merge_gate;
}

void tell_neighbours_apart(const std::vector<Look>& looks, const Explanation& explanation,
                           const SharedErrorEstimate& errors, double merge_radius_m, TrackTable& tracks,
                           SettledSums& settled) {
  const double reach_m = 2.0 * merge_radius_m;
  for (RestingObject& seen : tracks) {
    if (!seen.is_seen) continue;
    for (RestingObject& other : tracks) {
      if (&other == &seen || apart(other, seen).squaredNorm() > reach_m * reach_m) continue;
      if (other.is_seen) {
        seen.neighbours.seen_apart(other.track.id);
        if (seen.track.id < other.track.id)
          split_if_mixed(seen, other, looks[*seen.look], explanation.match_of_look[*seen.look], errors,
                         settled);
      } else if (other.detection_probability > 0.0) {
        seen.neighbours.seen_as_one(other.track.id);
        other.neighbours.seen_as_one(seen.track.id);
      }
    }
  }
}

}  // namespace geoloc
