// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/moving_tracker.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "geoloc/tracking/visibility.hpp"

namespace geoloc {
namespace {

constexpr int kNone = -1;
/// Chi-square, 4 degrees of freedom, 99 %: two tracks of one object.
constexpr double kMergeGate = 13.3;
constexpr int kHitsToCompare = 3;

/// Of a look against a track: the detector's noise, and what calibration, drift and frame shift the one and
/// not the other.
Eigen::Matrix2d noise_against(const Look& look, const SharedError::Row& gain) {
  const SharedError::Row difference = look.jacobian - gain;
  return look.pixel_noise + difference.lazyProduct(difference.transpose());
}

/// Of calibration and drift; the noise of a frame is its own.
SharedError::Row lasting(SharedError::Row jacobian) {
  jacobian.rightCols<SharedError::kSize - SharedError::kFrame>().setZero();
  return jacobian;
}

}  // namespace

MovingTracker::MovingTracker(const JointTrackerConfig& config, int max_detections) : config_(config) {
  if (config.moving.classes.empty()) return;
  const auto tracks = static_cast<std::size_t>(config.max_tracks);
  tracks_.reserve(tracks);
  estimates_.reserve(tracks);
  active_.reserve(tracks);
  is_seen_.reserve(tracks);
  track_of_look_.reserve(static_cast<std::size_t>(max_detections));
  costs_.resize(max_detections, config.max_tracks);
  assignment_.reserve(max_detections, config.max_tracks);
}

bool MovingTracker::is_of_moving_class(const Detection& detection) const {
  const std::vector<int>& classes = config_.moving.classes;
  return std::find(classes.begin(), classes.end(), detection.class_id) != classes.end();
}

void MovingTracker::update(const std::vector<Look>& looks, const Frame& frame, TrackBook& book) {
  predict(frame.view.vehicle.time);
  associate(looks);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (track_of_look_[i] != kNone) absorb(static_cast<std::size_t>(track_of_look_[i]), looks[i], frame);
  }
  weigh_missed(frame);
  note_same_frame_evidence();
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (track_of_look_[i] == kNone) start(looks[i], frame, book);
  }
  remove_improbable(book.counters);
  merge_duplicates(book.counters);
}

/// Those not seen for long could be anywhere: no look is theirs any more.
void MovingTracker::predict(VehicleTime now) {
  const double pause_s = std::max(0.0, seconds(now - predicted_to_));
  predicted_to_ = now;
  active_.clear();
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    Estimate& estimate = estimates_[k];
    const double unseen_s = seconds(now - estimate.last_look);
    estimate.is_lost = estimate.is_lost || !(unseen_s >= 0.0 && unseen_s <= config_.moving.memory_s);
    if (estimate.is_lost) continue;
    estimate.motion.predict(pause_s, config_.moving.sigma_acceleration_mps2);
    active_.push_back(k);
  }
}

void MovingTracker::associate(const std::vector<Look>& looks) {
  auto costs = costs_.topLeftCorner(static_cast<Eigen::Index>(looks.size()),
                                    static_cast<Eigen::Index>(active_.size()));
  for (std::size_t i = 0; i < looks.size(); ++i) {
    for (std::size_t c = 0; c < active_.size(); ++c) {
      const Estimate& estimate = estimates_[active_[c]];
      const Eigen::Matrix2d covariance =
          estimate.motion.position_covariance() + noise_against(looks[i], estimate.gain);
      const bool is_same_class = looks[i].detection->class_id == tracks_[active_[c]].class_id();
      costs(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) =
          mahalanobis_squared(looks[i].position - estimate.motion.position(), covariance) +
          (is_same_class ? 0.0 : config_.class_mismatch_cost);
    }
  }
  const std::vector<int>& column_of_look = assignment_.solve(costs, config_.gate);
  track_of_look_.assign(looks.size(), kNone);
  is_seen_.assign(tracks_.size(), false);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (column_of_look[i] == AssignmentSolver::kUnassigned) continue;
    const std::size_t k = active_[static_cast<std::size_t>(column_of_look[i])];
    track_of_look_[i] = static_cast<int>(k);
    is_seen_[k] = true;
  }
}

void MovingTracker::absorb(std::size_t k, const Look& look, const Frame& frame) {
  Track& track = tracks_[k];
  Estimate& estimate = estimates_[k];
  const Eigen::Matrix2d noise = noise_against(look, estimate.gain);
  const Eigen::Matrix2d covariance = estimate.motion.position_covariance() + noise;
  const Eigen::Vector2d innovation = look.position - estimate.motion.position();
  estimate.existence.hit(frame.detection_probability, density(innovation, covariance), look.clutter_density);
  const ConstantVelocity::Gain gain = estimate.motion.update(look.position, noise);
  // What shifts the looks shifts the track as far as it follows them.
  estimate.gain += gain.topRows<2>() * (lasting(look.jacobian) - estimate.gain);
  estimate.last_look = frame.view.vehicle.time;
  estimate.size_m += (look.size_m - estimate.size_m) / (track.hits + 1);
  record_detection(track, *look.detection, frame.view.captured_at_host);
  track.position_in_enu = {estimate.motion.position(),
                           estimate.motion.position_covariance() +
                               estimate.gain.lazyProduct(estimate.gain.transpose()) +
                               frame.offset_covariance};
  track.velocity_in_enu = Gaussian2{estimate.motion.velocity(), estimate.motion.velocity_covariance()};
  if (estimate.existence.probability() >= config_.confirm_probability) track.status = TrackStatus::kConfirmed;
}

void MovingTracker::start(const Look& look, const Frame& frame, TrackBook& book) {
  if (tracks_.size() >= static_cast<std::size_t>(config_.max_tracks)) {
    ++book.counters.refused;
    return;
  }
  Estimate estimate;
  estimate.motion = ConstantVelocity::at(look.position, noise_against(look, lasting(look.jacobian)),
                                         config_.moving.sigma_speed_mps);
  estimate.gain = lasting(look.jacobian);
  estimate.existence = Existence(config_.birth_probability);
  estimate.last_look = frame.view.vehicle.time;
  estimate.size_m = look.size_m;
  Track track;
  track.id = book.next_id++;
  track.first_seen = frame.view.captured_at_host;
  record_detection(track, *look.detection, frame.view.captured_at_host);
  track.position_in_enu = {
      look.position, look.pixel_noise + look.jacobian * look.jacobian.transpose() + frame.offset_covariance};
  tracks_.push_back(track);
  estimates_.push_back(estimate);
  is_seen_.push_back(true);
  ++book.counters.created;
}

void MovingTracker::weigh_missed(const Frame& frame) {
  for (const std::size_t k : active_) {
    if (is_seen_[k]) continue;
    Estimate& estimate = estimates_[k];
    ShownObject object;
    object.position_in_enu = estimate.motion.position() - frame.correction;
    object.sigma_m = std::sqrt(estimate.motion.position_covariance().trace());
    object.size_m = estimate.size_m;
    estimate.existence.miss(frame.detection_probability * visibility(object, frame.projector, frame.view,
                                                                     config_.sigma_px,
                                                                     config_.smallest_object_px));
  }
}

void MovingTracker::note_same_frame_evidence() {
  for (const std::size_t a : active_) {
    for (const std::size_t b : active_) {
      if (a != b && is_seen_[a] && is_seen_[b]) estimates_[a].neighbours.seen_apart(tracks_[b].id);
    }
  }
}

/// What was confirmed was there: not being where it was predicted does not unmake it.
void MovingTracker::remove_improbable(TrackCounters& counters) {
  for (std::size_t k = tracks_.size(); k-- > 0;) {
    Estimate& estimate = estimates_[k];
    const bool is_improbable = estimate.existence.probability() < config_.delete_probability;
    if (tracks_[k].status == TrackStatus::kConfirmed) {
      estimate.is_lost = estimate.is_lost || is_improbable;
      if (!estimate.is_lost) tracks_[k].existence = estimate.existence.probability();
    } else if (is_improbable || estimate.is_lost) {
      remove(k);
      ++counters.removed;
    } else {
      tracks_[k].existence = estimate.existence.probability();
    }
  }
}

bool MovingTracker::are_one(std::size_t a, std::size_t b) const {
  if (estimates_[a].is_lost || estimates_[b].is_lost) return false;
  if (std::min(tracks_[a].hits, tracks_[b].hits) < kHitsToCompare) return false;
  if (estimates_[a].neighbours.are_apart(tracks_[b].id)) return false;
  const ConstantVelocity &first = estimates_[a].motion, &second = estimates_[b].motion;
  const Eigen::Vector4d difference = first.mean - second.mean;
  if (difference.head<2>().norm() > config_.merge_radius_m) return false;
  const Eigen::Matrix4d covariance = first.covariance + second.covariance;
  return difference.dot(covariance.llt().solve(difference)) < kMergeGate;
}

/// The older track goes on, with the better estimate of the two.
void MovingTracker::merge_duplicates(TrackCounters& counters) {
  for (std::size_t a = 0; a < tracks_.size(); ++a) {
    for (std::size_t b = tracks_.size(); b-- > a + 1;) {
      if (!are_one(a, b)) continue;
      Estimate& kept = estimates_[a];
      const Estimate& gone = estimates_[b];
      if (gone.motion.covariance.trace() < kept.motion.covariance.trace()) {
        kept.motion = gone.motion;
        kept.gain = gone.gain;
        tracks_[a].position_in_enu = tracks_[b].position_in_enu;
        tracks_[a].velocity_in_enu = tracks_[b].velocity_in_enu;
      }
      kept.last_look = std::max(kept.last_look, gone.last_look);
      kept.existence.merge(gone.existence);
      kept.neighbours.merge(gone.neighbours);
      for (Estimate& estimate : estimates_) estimate.neighbours.rename(tracks_[b].id, tracks_[a].id);
      merge_records(tracks_[a], tracks_[b]);
      remove(b);
      ++counters.merged;
    }
  }
}

void MovingTracker::remove(std::size_t k) {
  tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(k));
  estimates_.erase(estimates_.begin() + static_cast<std::ptrdiff_t>(k));
}

}  // namespace geoloc
