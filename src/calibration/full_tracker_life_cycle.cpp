// SPDX-License-Identifier: Apache-2.0
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geoloc/calibration/full_tracker.hpp"
#include "geoloc/calibration/visibility.hpp"
#include "geoloc/geometry/angles.hpp"

// What becomes of tracks: seen, missed, begun, removed, merged.
namespace geoloc {
namespace {

/// What two tracks of one object may differ by beyond their stated noise: its looks differ with the
/// direction.
constexpr double kSigmaSameObject_m = 0.15;
/// Looks to remember: the detection probability follows the light and the ground.
constexpr double kMostOpportunities = 2000.0;
/// Looks beside a younger neighbour that may show that a track was made of looks at both, how far they must
/// be off together (chi-square, 2 degrees of freedom, 99.9 %), and how near to the line away from it.
constexpr int kLooksToSplit = 5;
constexpr double kSplitGate = 13.8;
constexpr double kSplitCosine = 0.7;
constexpr double kLeastSplit_m = 0.1;  // a box's centre is not the same point of an object from everywhere

}  // namespace

/// As counted; never certain either way.
double FullTracker::counted_detection_probability() const {
  return std::clamp(expected_hits_ / opportunities_, 0.05, 0.98);
}

/// Two tracks that two looks of one frame made, or were matched to, are two objects.
void FullTracker::note_same_frame_evidence() {
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
bool FullTracker::is_drawn_aside(std::size_t track, std::size_t younger) const {
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
void FullTracker::split_if_mixed(std::size_t track, std::size_t younger) {
  const auto look_index = static_cast<std::size_t>(look_of_track_[track]);
  const JointAssociation::Match& match = (*matches_)[look_index];
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

/// Where this frame would show a place: corrections undone.
Eigen::Vector2d FullTracker::shown_in_frame(const Eigen::Vector2d& position_in_enu) const {
  return position_in_enu - calibration_.offset_m() - drift_now_.head<2>() + shift_;
}

/// Of a track in this frame: what was counted so far, where it is to be seen well.
double FullTracker::detection_probability(std::size_t track, const Projector& projector,
                                          const FrameView& view) const {
  ShownObject object;
  object.position_in_enu = shown_in_frame(tracks_[track].position_in_enu.mean);
  object.sigma_m = std::sqrt(estimates_[track].own_covariance.trace() + estimates_[track].gain.squaredNorm());
  object.size_m = estimates_[track].size_m;
  if (is_seen(track)) {  // its look's is as good and known already
    object.ground_per_pixel_m = looks_[static_cast<std::size_t>(look_of_track_[track])].ground_per_pixel_m;
  }
  return visibility(object, projector, view, config_.sigma_px, config_.smallest_object_px) *
         counted_detection_probability();
}

void FullTracker::weigh_missed(const Projector& projector, const FrameView& view) {
  detection_probability_of_track_.assign(tracks_.size(), 0.0);
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    if (is_in_doubt_[k]) continue;
    const bool is_seen_now = is_seen(k);
    if (is_seen_now && tracks_[k].status != TrackStatus::kConfirmed) continue;
    const double probability = detection_probability(k, projector, view);
    if (probability <= 0.0) continue;
    detection_probability_of_track_[k] = probability;
    if (!is_seen_now) {
      estimates_[k].existence.miss(probability);
      ++tracks_[k].penalty;
    }
    if (tracks_[k].status == TrackStatus::kConfirmed) {
      opportunities_ += 1.0;
      expected_hits_ += is_seen_now ? 1.0 : 0.0;
    }
  }
  if (opportunities_ > kMostOpportunities) {
    opportunities_ *= 0.5;
    expected_hits_ *= 0.5;
  }
}

void FullTracker::absorb(std::size_t k, const Look& look) {
  Track& track = tracks_[k];
  Estimate& estimate = estimates_[k];
  estimate.last_look = now_;
  estimate.size_m += (look.size_m - estimate.size_m) / (track.hits + 1);
  ++track.hits;
  track.confidence_sum += look.detection->confidence;
  track.class_votes.add(look.detection->class_id, look.detection->confidence);
  add_to_sums(k, look);
}

void FullTracker::add_to_sums(std::size_t k, const Look& look) {
  landmarks_[estimates_[k].landmark].add(look.observation, drift_);
  estimates_[k].pixel_information += look.pixel_noise.inverse();
  refresh(k);
}

/// Of a track that this look begins.
Eigen::Matrix2d FullTracker::covariance_of_first(const Look& look) const {
  return look.pixel_noise + look.jacobian * look.jacobian.transpose();
}

/// Share of a track's sums that comes from the drift nodes of this moment.
Eigen::Matrix<double, 2, kNodeSize> FullTracker::recent_drift(const Landmark& landmark) const {
  Eigen::Matrix<double, 2, kNodeSize> sum = Eigen::Matrix<double, 2, kNodeSize>::Zero();
  for (const Landmark::NodeTerms& terms : landmark) {
    if (terms.number >= span_.first) sum += terms.B;
  }
  return sum;
}

/// Position and its derivatives from the sums.
void FullTracker::refresh(std::size_t k) {
  Estimate& estimate = estimates_[k];
  const Landmark& landmark = landmarks_[estimate.landmark];
  estimate.own_covariance = landmark.A().inverse();
  estimate.gain = whitened(estimate.own_covariance * landmark.B().leftCols<SharedError::kCalibrationSize>(),
                           estimate.own_covariance * recent_drift(landmark));
  tracks_[k].position_in_enu.mean = landmark.position(calibration_.mean, drift_);
}

void FullTracker::absorb_matched(HostTime captured_at) {
  const double found = counted_detection_probability();
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (!is_matched(i)) continue;
    const JointAssociation::Match& match = (*matches_)[i];
    const auto k = static_cast<std::size_t>(match.track);
    const Eigen::Matrix2d& covariance = match.innovation_covariance;
    const double likelihood = std::exp(-0.5 * mahalanobis_squared(match.innovation, covariance)) /
                              (2.0 * kPi * std::sqrt(covariance.determinant()));
    estimates_[k].existence.hit(found, likelihood, looks_[i].clutter_density);
    absorb(k, looks_[i]);
    tracks_[k].last_seen = captured_at;
    tracks_[k].penalty = std::max(0, tracks_[k].penalty - 1);
    if (estimates_[k].existence.probability() >= config_.confirm_probability) {
      tracks_[k].status = TrackStatus::kConfirmed;
    }
  }
}

void FullTracker::start_tentative(HostTime captured_at) {
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if ((*matches_)[i].track != JointAssociation::kNone) continue;
    if (tracks_.size() >= static_cast<std::size_t>(config_.max_tracks)) {
      ++book_.counters.refused;
      continue;
    }
    Estimate estimate;
    estimate.existence = Existence(config_.birth_probability);
    if (free_landmarks_.empty()) {
      estimate.landmark = landmarks_.size();
      landmarks_.emplace_back();
    } else {
      estimate.landmark = free_landmarks_.back();
      free_landmarks_.pop_back();
      landmarks_[estimate.landmark] = Landmark{};
    }
    Track track;
    track.id = book_.next_id++;
    track.first_seen = track.last_seen = captured_at;
    tracks_.push_back(track);
    estimates_.push_back(estimate);
    look_of_track_.push_back(static_cast<int>(i));
    detection_probability_of_track_.push_back(0.0);
    absorb(tracks_.size() - 1, looks_[i]);
    tracks_.back().position_in_enu.covariance = covariance_of_first(looks_[i]);
    ++book_.counters.created;
  }
}

void FullTracker::remove(std::size_t k) {
  free_landmarks_.push_back(estimates_[k].landmark);
  tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(k));
  estimates_.erase(estimates_.begin() + static_cast<std::ptrdiff_t>(k));
}

void FullTracker::remove_improbable() {
  for (std::size_t k = tracks_.size(); k-- > 0;) {
    tracks_[k].existence = estimates_[k].existence.probability();
    if (*tracks_[k].existence >= config_.delete_probability) continue;
    known_points_.forget(tracks_[k].id);
    remove(k);
    ++book_.counters.removed;
  }
}

/// Of the difference of two tracks. Their own noise is that of association: the sums count the noise of each
/// frame as often as frames repeat it, which is too much for tracks that the same frames made.
Eigen::Matrix2d FullTracker::covariance_of_difference(std::size_t a, std::size_t b) const {
  const Estimate &first = estimates_[a], &second = estimates_[b];
  const double fresh = 1.0 - shared_share_of_noise(first.last_look - second.last_look);
  const double shares = noise_share(tracks_[a]) + noise_share(tracks_[b]);
  return solver_.covariance_of_difference(landmarks_[first.landmark], landmarks_[second.landmark], drift_) -
         first.own_covariance - second.own_covariance + first.pixel_information.inverse() +
         second.pixel_information.inverse() + fresh * shares * frame_noise_ +
         2.0 * kSigmaSameObject_m * kSigmaSameObject_m * Eigen::Matrix2d::Identity();
}

/// What the frames' common noise leaves in a track: all of it, until it was seen for longer than that lasts.
double FullTracker::noise_share(const Track& track) const {
  return std::min(1.0, noise_correlation_ / track.hits);
}

/// Perhaps one object: near each other, known well enough to tell, and never seen side by side.
bool FullTracker::may_be_one(std::size_t a, std::size_t b) const {
  const Eigen::Vector2d apart = tracks_[a].position_in_enu.mean - tracks_[b].position_in_enu.mean;
  return apart.squaredNorm() <= config_.merge_radius_m * config_.merge_radius_m &&
         !(estimates_[a].is_known && estimates_[b].is_known) &&
         std::min(tracks_[a].hits, tracks_[b].hits) >= kHitsToCompare &&
         !estimates_[a].neighbours.are_apart(tracks_[b].id) &&
         mahalanobis_squared(apart, covariance_of_difference(a, b)) <= config_.merge_gate;
}

/// All that is known of track b goes to track a.
void FullTracker::merge(std::size_t a, std::size_t b) {
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

void FullTracker::merge_compatible() {
  for (std::size_t a = 0; a < tracks_.size(); ++a) {
    for (std::size_t b = a + 1; b < tracks_.size();) {
      if (may_be_one(a, b)) {
        merge(a, b);
      } else {
        ++b;
      }
    }
  }
}
}  // namespace geoloc
