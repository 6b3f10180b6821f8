// SPDX-License-Identifier: Apache-2.0
#include "tracking/look_matcher.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <tuple>

namespace geoloc {
namespace {

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

SharedError::Row mean_jacobian(const std::vector<Look>& looks) {
  SharedError::Row mean = SharedError::Row::Zero();
  for (const Look& look : looks) mean += look.jacobian;
  mean /= static_cast<double>(looks.size());
  return mean;
}

bool is_older(const RestingObject& object, const RestingObject& other) {
  const Track &a = object.track, &b = other.track;
  return std::make_tuple(a.status == TrackStatus::kConfirmed, a.hits, b.id) >
         std::make_tuple(b.status == TrackStatus::kConfirmed, b.hits, a.id);
}

}  // namespace

LookMatcher::LookMatcher(const JointTrackerConfig& config, int max_detections)
    : config_(config), association_(max_detections, config.max_tracks) {
  explanation_.match_of_look.reserve(max_detections);
  reach_of_track_.reserve(config.max_tracks);
  median_scratch_.reserve(max_detections);
}

const Explanation& LookMatcher::explain(const std::vector<Look>& looks, const FrameNoise& noise,
                                        VehicleTime now, TrackTable& tracks) {
  association_.begin(looks.size(), config_.gate, config_.ambiguity);
  add_pairings(looks, noise, now, tracks);
  explanation_.match_of_look = association_.solve();
  prefer_older_twins(tracks);
  explanation_.common_shift = common_shift(looks, tracks);
  note_evidence(tracks);
  return explanation_;
}

void LookMatcher::list_reaches(const TrackTable& tracks, const SharedError::Row& mean,
                               double frame_variance) {
  reach_of_track_.clear();
  for (const RestingObject& track : tracks) {
    reach_of_track_.push_back({track.track.position_in_enu.mean,
                               track.own_covariance.trace() + frame_variance,
                               (track.sensitivity - mean).norm()});
  }
}

/// All tracks that a look may show; those that are farther than the trace of the covariance allows are not
/// looked at closely.
void LookMatcher::add_pairings(const std::vector<Look>& looks, const FrameNoise& noise, VehicleTime now,
                               const TrackTable& tracks) {
  if (looks.empty()) return;
  const SharedError::Row mean = mean_jacobian(looks);
  list_reaches(tracks, mean, noise.covariance.trace());
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const Reach look{looks[i].position, looks[i].pixel_noise.trace(), (looks[i].jacobian - mean).norm()};
    for (std::size_t k = 0; k < tracks.size(); ++k) {
      const Reach& track = reach_of_track_[k];
      const double shared_m = look.shared_m + track.shared_m;
      const double variance = look.own_variance + track.own_variance + shared_m * shared_m;
      const bool is_within_reach = (look.position - track.position).squaredNorm() < config_.gate * variance;
      if (!is_within_reach) continue;
      Pairing pair = pairing(looks[i], tracks[k], noise, now);
      pair.look = i;
      pair.track = k;
      association_.add(pair);
    }
  }
}

/// Frames within a second share most of their noise: it cancels between a look and a track that was seen just
/// now, and a track seen for a short time only has it whole.
Pairing LookMatcher::pairing(const Look& look, const RestingObject& track, const FrameNoise& noise,
                             VehicleTime now) const {
  const double share = noise.share_in_track(track.track.hits);
  const double fresh = 1.0 - share * noise.common_share(now - track.last_look);
  Pairing pairing;
  pairing.residual = look.position - track.track.position_in_enu.mean;
  pairing.jacobian = look.jacobian - track.sensitivity;
  pairing.jacobian.middleCols<2>(SharedError::kFrame) *= std::sqrt(fresh);
  pairing.own_covariance =
      look.pixel_noise + track.pixel_information.inverse() + fresh * share * noise.covariance;
  pairing.penalty = look.detection.class_id == track.track.class_id() ? 0.0 : config_.class_mismatch_cost;
  return pairing;
}

/// A look that may show either of two tracks, which no other look of the frame can show and no frame has
/// shown side by side, shows one object that was begun twice: the look is the older one's, and the younger
/// one dies of being missed. Otherwise both would be in doubt for ever, and learn nothing.
void LookMatcher::prefer_older_twins(const TrackTable& tracks) {
  std::vector<JointAssociation::Match>& matches = explanation_.match_of_look;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!matches[i].is_ambiguous) continue;
    if (const Pairing* const oldest = oldest_twin(i, tracks))
      matches[i] = JointAssociation::match_of(*oldest);
  }
}

/// Among the pairs of this look; none where they are not twins.
const Pairing* LookMatcher::oldest_twin(std::size_t look, const TrackTable& tracks) const {
  const Pairing* oldest = nullptr;
  for (const Pairing& pairing : association_.pairings()) {
    if (pairing.look != look) continue;
    if (association_.looks_at(pairing.track) > 1) return nullptr;
    if (oldest == nullptr || is_older(tracks[pairing.track], tracks[oldest->track])) oldest = &pairing;
  }
  if (oldest == nullptr) return nullptr;
  int twins = 0;
  const Neighbours& neighbours = tracks[oldest->track].neighbours;
  for (const Pairing& pairing : association_.pairings()) {
    if (pairing.look != look || pairing.track == oldest->track) continue;
    const Track& twin = tracks[pairing.track].track;
    if (twin.hits >= kHitsToCompare || neighbours.are_apart(twin.id)) return nullptr;
    ++twins;
  }
  return twins > 0 ? oldest : nullptr;
}

/// Median of the residuals: what all looks of this frame share.
Eigen::Vector2d LookMatcher::common_shift(const std::vector<Look>& looks, const TrackTable& tracks) {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    median_scratch_.clear();
    for (std::size_t i = 0; i < looks.size(); ++i) {
      const auto track = explanation_.match_of_look[i].track;
      if (!track) continue;
      median_scratch_.push_back(looks[i].position[axis] - tracks[*track].track.position_in_enu.mean[axis]);
    }
    if (median_scratch_.size() >= 2) shift[axis] = median(median_scratch_);
  }
  return shift;
}

void LookMatcher::note_evidence(TrackTable& tracks) const {
  const std::vector<JointAssociation::Match>& matches = explanation_.match_of_look;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!matches[i].is_certain()) continue;
    tracks[*matches[i].track].look = i;
    tracks[*matches[i].track].is_seen = true;
  }
  for (const Pairing& pairing : association_.pairings()) {
    if (matches[pairing.look].is_ambiguous) tracks[pairing.track].is_in_doubt = true;
  }
}

}  // namespace geoloc
