// SPDX-License-Identifier: Apache-2.0
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geoloc/calibration/full_tracker.hpp"
#include "geoloc/geometry/angles.hpp"

// What becomes of tracks: seen, missed, begun, removed, merged.
namespace geoloc {
namespace {

/// What two tracks of one object may differ by beyond their stated noise: its looks differ with the
/// direction.
constexpr double kSigmaSameObject_m = 0.15;
/// Looks to remember: the detection probability follows the light and the ground.
constexpr double kMostOpportunities = 2000.0;

/// Of detection, as counted; never certain either way.
double counted_probability(double hits, double opportunities) {
  return std::clamp(hits / opportunities, 0.05, 0.98);
}

}  // namespace

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
      } else if (detection_probability_of_track_[other] > 0.0) {
        estimates_[seen].neighbours.seen_as_one(tracks_[other].id);
        estimates_[other].neighbours.seen_as_one(tracks_[seen].id);
      }
    }
  }
}

/// Where this frame would show a place: corrections undone.
Eigen::Vector2d FullTracker::shown_in_frame(const Eigen::Vector2d& position_in_enu) const {
  return position_in_enu - calibration_.offset_m() - drift_now_.head<2>() + shift_;
}

/// At a track's place; its look's, where it has one, is as good and known already.
std::optional<double> FullTracker::ground_per_pixel(std::size_t track, const Eigen::Vector2d& pixel,
                                                    const Projector& projector, const FrameView& view) const {
  if (is_seen(track)) return looks_[static_cast<std::size_t>(look_of_track_[track])].ground_per_pixel_m;
  const auto fix = projector.project(pixel, view.enu_from_camera);
  if (!fix) return std::nullopt;
  return std::sqrt(std::abs(fix->ground_from_pixel.determinant()));
}

/// Zero outside the image, at its edge and for objects too small; otherwise what was counted so far.
double FullTracker::detection_probability(std::size_t track, const Projector& projector,
                                          const FrameView& view) const {
  const Eigen::Vector2d shown = shown_in_frame(tracks_[track].position_in_enu.mean);
  const auto pixel = projector.reproject(shown, view.enu_from_camera);
  if (!pixel) return 0.0;
  const auto ground_per_pixel_m = ground_per_pixel(track, *pixel, projector, view);
  if (!ground_per_pixel_m) return 0.0;
  const double pixel_per_m = 1.0 / *ground_per_pixel_m;
  const double size_px = estimates_[track].size_m * pixel_per_m;
  const double sigma_px =
      std::sqrt(estimates_[track].own_covariance.trace() + estimates_[track].gain.squaredNorm()) *
      pixel_per_m;
  const double margin_px = 0.6 * size_px + 2.0 * std::min(sigma_px, size_px) + 2.0 * config_.sigma_px;
  if (!projector.camera().contains(*pixel, margin_px)) return 0.0;
  const double seen_well = std::clamp(size_px / std::max(config_.smallest_object_px, 1e-9) - 1.0, 0.0, 1.0);
  return seen_well * counted_probability(expected_hits_, opportunities_);
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
  landmarks_[estimate.landmark].add(look.observation, drift_);
  estimate.pixel_information += look.pixel_noise.inverse();
  estimate.last_look = now_;
  estimate.size_m += (look.size_m - estimate.size_m) / (track.hits + 1);
  ++track.hits;
  track.confidence_sum += look.detection->confidence;
  track.class_votes.add(look.detection->class_id, look.detection->confidence);
  refresh(k);
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
  const double found = counted_probability(expected_hits_, opportunities_);
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
      ++counters_.refused;
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
    track.id = next_id_++;
    track.first_seen = track.last_seen = captured_at;
    tracks_.push_back(track);
    estimates_.push_back(estimate);
    look_of_track_.push_back(static_cast<int>(i));
    detection_probability_of_track_.push_back(0.0);
    absorb(tracks_.size() - 1, looks_[i]);
    tracks_.back().position_in_enu.covariance =
        looks_[i].pixel_noise + looks_[i].jacobian * looks_[i].jacobian.transpose();
    ++counters_.created;
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
    ++counters_.removed;
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
  ++counters_.merged;
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
