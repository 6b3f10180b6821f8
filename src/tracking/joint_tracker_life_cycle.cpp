// SPDX-License-Identifier: Apache-2.0
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geoloc/tracking/joint_tracker.hpp"
#include "geoloc/tracking/visibility.hpp"

// What becomes of tracks: seen, missed, begun, removed.
namespace geoloc {
namespace {

/// Looks to remember: the detection probability follows the light and the ground.
constexpr double kMostOpportunities = 2000.0;

}  // namespace

/// As counted; never certain either way.
double JointTracker::counted_detection_probability() const {
  return std::clamp(expected_hits_ / opportunities_, 0.05, 0.98);
}

/// Where this frame would show a place: corrections undone.
Eigen::Vector2d JointTracker::shown_in_frame(const Eigen::Vector2d& position_in_enu) const {
  return position_in_enu - calibration_.offset_m() - drift_now_.head<2>() + shift_;
}

/// Of a track in this frame: what was counted so far, where it is to be seen well.
double JointTracker::detection_probability(std::size_t track, const Projector& projector,
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

/// A younger track that may be the same object has this frame's look: begun when the vehicle came back with
/// another drift, it would outlive the older one, and all that this one knows. nullopt: there is none.
std::optional<std::size_t> JointTracker::seen_as(std::size_t k) const {
  if (tracks_[k].status != TrackStatus::kConfirmed) return std::nullopt;
  for (std::size_t other = 0; other < tracks_.size(); ++other) {
    const bool is_young = tracks_[other].id > tracks_[k].id && tracks_[other].hits <= kHitsToCompare;
    if (is_young && is_seen(other) && are_not_told_apart(k, other)) return other;
  }
  return std::nullopt;
}

void JointTracker::weigh_missed(const Projector& projector, const FrameView& view) {
  detection_probability_of_track_.assign(tracks_.size(), 0.0);
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    if (is_in_doubt_[k]) {
      compare_soon(k);
      continue;
    }
    const bool is_seen_now = is_seen(k);
    if (is_seen_now && tracks_[k].status != TrackStatus::kConfirmed) continue;
    const double probability = detection_probability(k, projector, view);
    if (probability <= 0.0) continue;
    detection_probability_of_track_[k] = probability;
    if (!is_seen_now) {
      if (const auto other = seen_as(k)) {
        compare_soon(*other);
        continue;
      }
      estimates_[k].existence.miss(probability);
      ++tracks_[k].penalty;
    }
    if (tracks_[k].status == TrackStatus::kConfirmed) count_opportunity(is_seen_now);
  }
}

/// For the detection probability.
void JointTracker::count_opportunity(bool was_seen) {
  opportunities_ += 1.0;
  expected_hits_ += was_seen ? 1.0 : 0.0;
  if (opportunities_ > kMostOpportunities) {
    opportunities_ *= 0.5;
    expected_hits_ *= 0.5;
  }
}

void JointTracker::absorb(std::size_t k, const Look& look, HostTime captured_at) {
  Track& track = tracks_[k];
  Estimate& estimate = estimates_[k];
  estimate.last_look = now_;
  estimate.size_m += (look.size_m - estimate.size_m) / (track.hits + 1);
  record_detection(track, *look.detection, captured_at);
  add_to_sums(k, look);
}

void JointTracker::add_to_sums(std::size_t k, const Look& look) {
  landmarks_[estimates_[k].landmark].add(look.observation, drift_);
  estimates_[k].pixel_information += look.pixel_noise.inverse();
  refresh(k);
}

/// Of a track that this look begins.
Eigen::Matrix2d JointTracker::covariance_of_first(const Look& look) const {
  return look.pixel_noise + look.jacobian * look.jacobian.transpose();
}

/// Share of a track's sums that comes from the drift nodes of this moment.
Eigen::Matrix<double, 2, kNodeSize> JointTracker::recent_drift(const Landmark& landmark) const {
  Eigen::Matrix<double, 2, kNodeSize> sum = Eigen::Matrix<double, 2, kNodeSize>::Zero();
  for (const Landmark::NodeTerms& terms : landmark) {
    if (terms.number >= span_.first) sum += terms.B;
  }
  return sum;
}

/// Position and its derivatives from the sums.
void JointTracker::refresh(std::size_t k) {
  Estimate& estimate = estimates_[k];
  const Landmark& landmark = landmarks_[estimate.landmark];
  estimate.own_covariance = landmark.A().inverse();
  estimate.gain = whitened(estimate.own_covariance * landmark.B().leftCols<SharedError::kCalibrationSize>(),
                           estimate.own_covariance * recent_drift(landmark));
  tracks_[k].position_in_enu.mean = landmark.position(calibration_.mean, drift_);
}

void JointTracker::absorb_matched(HostTime captured_at) {
  const double found = counted_detection_probability();
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (!is_matched(i)) continue;
    const JointAssociation::Match& match = matches_[i];
    const auto k = static_cast<std::size_t>(match.track);
    estimates_[k].existence.hit(found, density(match.innovation, match.innovation_covariance),
                                looks_[i].clutter_density);
    absorb(k, looks_[i], captured_at);
    tracks_[k].penalty = std::max(0, tracks_[k].penalty - 1);
    if (estimates_[k].existence.probability() >= config_.confirm_probability) {
      tracks_[k].status = TrackStatus::kConfirmed;
    }
  }
}

void JointTracker::start_tentative(HostTime captured_at) {
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (matches_[i].track != JointAssociation::kNone) continue;
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
    track.first_seen = captured_at;
    tracks_.push_back(track);
    estimates_.push_back(estimate);
    look_of_track_.push_back(static_cast<int>(i));
    detection_probability_of_track_.push_back(0.0);
    absorb(tracks_.size() - 1, looks_[i], captured_at);
    tracks_.back().position_in_enu.covariance = covariance_of_first(looks_[i]);
    ++book_.counters.created;
  }
}

void JointTracker::remove(std::size_t k) {
  free_landmarks_.push_back(estimates_[k].landmark);
  tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(k));
  estimates_.erase(estimates_.begin() + static_cast<std::ptrdiff_t>(k));
}

void JointTracker::remove_improbable() {
  for (std::size_t k = tracks_.size(); k-- > 0;) {
    tracks_[k].existence = estimates_[k].existence.probability();
    if (*tracks_[k].existence >= config_.delete_probability) continue;
    known_points_.forget(tracks_[k].id);
    remove(k);
    ++book_.counters.removed;
  }
}

}  // namespace geoloc
