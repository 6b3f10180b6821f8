// SPDX-License-Identifier: Apache-2.0
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geoloc/tracking/joint_tracker.hpp"

// Which tracks are one object, and which object is two.
namespace geoloc {
namespace {

/// What two tracks of one object may differ by beyond their stated noise: its looks differ with the
/// direction.
constexpr double kSigmaSameObject_m = 0.15;
/// Looks beside a younger neighbour that may show that a track was made of looks at both, how far they must
/// be off together (chi-square, 2 degrees of freedom, 99.9 %), and how near to the line away from it.
constexpr int kLooksToSplit = 5;
constexpr double kSplitGate = 13.8;
constexpr double kSplitCosine = 0.7;
constexpr double kLeastSplit_m = 0.1;  // a box's centre is not the same point of an object from everywhere

}  // namespace

/// Two tracks that two looks of one frame made, or were matched to, are two objects.
void JointTracker::note_same_frame_evidence() {
  const double reach_m = 2.0 * config_.merge_radius_m;
  for (std::size_t seen = 0; seen < tracks_.size(); ++seen) {
    if (!is_seen(seen)) continue;
    for (std::size_t other = 0; other < tracks_.size(); ++other) {
      const Eigen::Vector2d apart = tracks_[other].position_in_enu.mean - tracks_[seen].position_in_enu.mean;
      if (other == seen || apart.squaredNorm() > reach_m * reach_m) continue;
      if (is_seen(other)) {
        estimates_[seen].neighbours.seen_apart(tracks_[other].id);
        if (tracks_[seen].id < tracks_[other].id) split_if_mixed(seen, other);
      } else if (detection_probability_of_track_[other] > 0.0) {
        estimates_[seen].neighbours.seen_as_one(tracks_[other].id);
        estimates_[other].neighbours.seen_as_one(tracks_[seen].id);
      }
    }
  }
}

/// Whether the looks that came beside a younger neighbour are drawn away from it by more than noise does.
bool JointTracker::is_drawn_aside(std::size_t track, std::size_t younger) const {
  const Mixture& mixture = estimates_[track].mixture;
  if (mixture.looks < kLooksToSplit) return false;
  const Eigen::Vector2d mean = mixture.sum_of_innovations / mixture.looks;
  const double noise = mixture.sum_of_noise / (mixture.looks * mixture.looks);
  if (mean.squaredNorm() < kSplitGate * noise + kLeastSplit_m * kLeastSplit_m) return false;
  const Eigen::Vector2d away = tracks_[track].position_in_enu.mean - tracks_[younger].position_in_enu.mean;
  return mean.dot(away) > kSplitCosine * mean.norm() * away.norm();
}

/// Of two neighbours that a detector took for one object for a while, the older track is made of looks at
/// both and lies between them. Once it is seen beside the younger one its looks are drawn to one side; then
/// it begins anew from them, since the sums do not tell which look showed which.
void JointTracker::split_if_mixed(std::size_t track, std::size_t younger) {
  const auto look_index = static_cast<std::size_t>(look_of_track_[track]);
  const JointAssociation::Match& match = matches_[look_index];
  Estimate& estimate = estimates_[track];
  if (match.track == JointAssociation::kNone || estimate.is_known) return;
  const Look& look = looks_[look_index];
  ++estimate.mixture.looks;
  estimate.mixture.sum_of_innovations += match.innovation;
  estimate.mixture.sum_of_noise += look.pixel_noise.trace();
  if (!is_drawn_aside(track, younger)) return;
  landmarks_[estimate.landmark] = Landmark{};
  estimate.pixel_information.setZero();
  estimate.mixture = Mixture{};
  add_to_sums(track, look);
  tracks_[track].position_in_enu.covariance = covariance_of_first(look);
}

/// Of the difference of two tracks. Their own noise is that of association: the sums count the noise of each
/// frame as often as frames repeat it, which is too much for tracks that the same frames made.
Eigen::Matrix2d JointTracker::covariance_of_difference(std::size_t a, std::size_t b) const {
  const Estimate &first = estimates_[a], &second = estimates_[b];
  const double fresh = 1.0 - shared_share_of_noise(first.last_look - second.last_look);
  const double shares = noise_share(tracks_[a]) + noise_share(tracks_[b]);
  return solver_.covariance_of_difference(landmarks_[first.landmark], landmarks_[second.landmark], drift_) -
         first.own_covariance - second.own_covariance + first.pixel_information.inverse() +
         second.pixel_information.inverse() + fresh * shares * frame_noise_ +
         2.0 * kSigmaSameObject_m * kSigmaSameObject_m * Eigen::Matrix2d::Identity();
}

/// What the frames' common noise leaves in a track: all of it, until it was seen for longer than that lasts.
double JointTracker::noise_share(const Track& track) const {
  return std::min(1.0, noise_correlation_ / track.hits);
}

/// Near each other, and never seen side by side.
bool JointTracker::are_not_told_apart(std::size_t a, std::size_t b) const {
  const Eigen::Vector2d apart = tracks_[a].position_in_enu.mean - tracks_[b].position_in_enu.mean;
  return apart.squaredNorm() <= config_.merge_radius_m * config_.merge_radius_m &&
         !estimates_[a].neighbours.are_apart(tracks_[b].id);
}

/// Perhaps one object: not told apart, and known well enough to tell.
bool JointTracker::may_be_one(std::size_t a, std::size_t b) const {
  const Eigen::Vector2d apart = tracks_[a].position_in_enu.mean - tracks_[b].position_in_enu.mean;
  return are_not_told_apart(a, b) && !(estimates_[a].is_known && estimates_[b].is_known) &&
         std::min(tracks_[a].hits, tracks_[b].hits) >= kHitsToCompare &&
         mahalanobis_squared(apart, covariance_of_difference(a, b)) <= config_.merge_gate;
}

/// All that is known of track b goes to track a.
void JointTracker::merge(std::size_t a, std::size_t b) {
  landmarks_[estimates_[a].landmark].merge(landmarks_[estimates_[b].landmark], drift_);
  estimates_[a].pixel_information += estimates_[b].pixel_information;
  estimates_[a].last_look = std::max(estimates_[a].last_look, estimates_[b].last_look);
  estimates_[a].is_known = estimates_[a].is_known || estimates_[b].is_known;
  known_points_.rename(tracks_[b].id, tracks_[a].id);
  estimates_[a].existence.merge(estimates_[b].existence);
  estimates_[a].neighbours.merge(estimates_[b].neighbours);
  for (Estimate& estimate : estimates_) estimate.neighbours.rename(tracks_[b].id, tracks_[a].id);
  merge_records(tracks_[a], tracks_[b]);
  remove(b);
  refresh(a);
  ++book_.counters.merged;
}

void JointTracker::merge_compatible() {
  for (std::size_t a = 0; a < tracks_.size(); ++a) {
    for (std::size_t b = a + 1; b < tracks_.size();) {
      if (may_be_one(a, b)) {
        merge(a, b);
      } else {
        ++b;
      }
    }
  }
  for (std::size_t k = 0; k < tracks_.size(); ++k)
    estimates_[k].is_compared = tracks_[k].hits >= kHitsToCompare;
}

/// A track that may be another's twin does not wait for the next solution, once it is known well enough.
void JointTracker::compare_soon(std::size_t track) {
  if (tracks_[track].hits >= kHitsToCompare && !estimates_[track].is_compared) is_comparison_due_ = true;
}

}  // namespace geoloc
