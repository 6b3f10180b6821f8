// SPDX-License-Identifier: Apache-2.0
#include "tracking/moving_tracker.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "geometry/room.hpp"
#include "tracking/gaussian.hpp"
#include "tracking/visibility.hpp"

namespace geoloc {
namespace {

/// Chi-square, 4 degrees of freedom, 99 %: two tracks of one object.
constexpr double kMergeGate = 13.3;

/// Noise of a look against a track [m^2]: the detector's, and what calibration, drift and frame shift the one
/// and not the other.
Eigen::Matrix2d noise_against(const Look& look, const SharedError::Row& sensitivity) {
  const SharedError::Row difference = look.jacobian - sensitivity;
  return look.pixel_noise + difference.lazyProduct(difference.transpose());
}

/// The part by calibration and drift; the noise of a frame is its own.
SharedError::Row lasting(SharedError::Row jacobian) {
  jacobian.rightCols<SharedError::kSize - SharedError::kFrame>().setZero();
  return jacobian;
}

}  // namespace

MovingTracker::MovingTracker(const JointTrackerConfig& config, int max_detections) : config_(config) {
  take_room(this, config, max_detections);
}

/// Where nothing moves there are no looks to match.
std::size_t MovingTracker::take_room(MovingTracker* self, const JointTrackerConfig& config,
                                     int max_detections) {
  const bool is_used = !config.moving.classes.empty();
  const int looks = is_used ? max_detections : 0, tracks = is_used ? config.max_tracks : 0;
  if (self != nullptr) self->assignment_.reserve(looks, tracks);
  return room::reserve(self, &MovingTracker::objects_, tracks) +
         room::reserve(self, &MovingTracker::active_, tracks) +
         room::reserve(self, &MovingTracker::row_of_look_, looks) +
         room::resize(self, &MovingTracker::costs_, looks, tracks) + AssignmentSolver::bytes(looks, tracks);
}

void MovingTracker::update(const std::vector<Look>& looks, const Context& context, TrackBook& book) {
  if (config_.moving.classes.empty()) return;
  predict(context.frame.time());
  associate(looks);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (row_of_look_[i]) absorb(objects_[*row_of_look_[i]], looks[i], context);
  }
  weigh_missed(context);
  note_same_frame_evidence();
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (!row_of_look_[i]) begin(looks[i], context, book);
  }
  remove_improbable(book.counters);
  merge_duplicates(book.counters);
}

/// Those not seen for long could be anywhere: no look is theirs any more.
void MovingTracker::predict(VehicleTime now) {
  const double pause_s = std::max(0.0, seconds(now - predicted_to_));
  predicted_to_ = now;
  active_.clear();
  for (std::size_t k = 0; k < objects_.size(); ++k) {
    MovingObject& object = objects_[k];
    const double unseen_s = seconds(now - object.last_look);
    object.is_lost = object.is_lost || !(unseen_s >= 0.0 && unseen_s <= config_.moving.memory_s);
    if (object.is_lost) continue;
    object.motion.predict(pause_s, config_.moving.sigma_acceleration_mps2);
    active_.push_back(k);
  }
}

void MovingTracker::associate(const std::vector<Look>& looks) {
  auto costs = costs_.topLeftCorner(looks.size(), active_.size());
  for (std::size_t i = 0; i < looks.size(); ++i) {
    for (std::size_t c = 0; c < active_.size(); ++c) {
      const MovingObject& object = objects_[active_[c]];
      const Eigen::Matrix2d covariance =
          object.motion.position_covariance() + noise_against(looks[i], object.sensitivity);
      const bool is_same_class = looks[i].detection.class_id == object.track.class_id();
      costs(i, c) = mahalanobis_squared(looks[i].position - object.motion.position(), covariance) +
                    (is_same_class ? 0.0 : config_.class_mismatch_cost);
    }
  }
  const std::vector<std::size_t>& column_of_look = assignment_.solve(costs, config_.gate);
  row_of_look_.assign(looks.size(), std::nullopt);
  for (MovingObject& object : objects_) object.is_seen = false;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (column_of_look[i] == AssignmentSolver::kUnassigned) continue;
    row_of_look_[i] = active_[column_of_look[i]];
    objects_[*row_of_look_[i]].is_seen = true;
  }
}

void MovingTracker::absorb(MovingObject& object, const Look& look, const Context& context) const {
  const Eigen::Matrix2d noise = noise_against(look, object.sensitivity);
  const Eigen::Matrix2d covariance = object.motion.position_covariance() + noise;
  const Eigen::Vector2d innovation = look.position - object.motion.position();
  object.existence.hit(context.detection_probability, density(innovation, covariance), look.clutter_density);
  const ConstantVelocity::Gain gain = object.motion.update(look.position, noise);
  // What shifts the looks shifts the track as far as it follows them.
  object.sensitivity += gain.topRows<2>() * (lasting(look.jacobian) - object.sensitivity);
  record_look(object, look, context.frame.time(), context.frame.view.captured_at_host);
  object.height_m = look.terrain_m;
  object.track.position_in_enu = {object.motion.position(),
                                  object.motion.position_covariance() +
                                      object.sensitivity.lazyProduct(object.sensitivity.transpose()) +
                                      context.offset_covariance};
  object.track.velocity_in_enu = Gaussian2{object.motion.velocity(), object.motion.velocity_covariance()};
  confirm_if_probable(object, config_.confirm_probability);
}

void MovingTracker::begin(const Look& look, const Context& context, TrackBook& book) {
  if (objects_.size() >= static_cast<std::size_t>(config_.max_tracks)) {
    ++book.counters.refused;
    return;
  }
  MovingObject& object = objects_.emplace_back();
  begin_object(object, look, config_.birth_probability, context.frame.view.captured_at_host, book);
  record_look(object, look, context.frame.time(), context.frame.view.captured_at_host);
  object.height_m = look.terrain_m;
  object.motion = ConstantVelocity::at(look.position, noise_against(look, lasting(look.jacobian)),
                                       config_.moving.sigma_speed_mps);
  object.sensitivity = lasting(look.jacobian);
  object.track.position_in_enu = {
      look.position,
      look.pixel_noise + look.jacobian * look.jacobian.transpose() + context.offset_covariance};
}

void MovingTracker::weigh_missed(const Context& context) {
  for (const std::size_t k : active_) {
    MovingObject& object = objects_[k];
    if (object.is_seen) continue;
    ShownObject shown;
    shown.position_in_enu << object.motion.position() - context.shift.correction(),
        context.shift.level_m + object.height_m;
    shown.sigma_m = std::sqrt(object.motion.position_covariance().trace());
    shown.size_m = object.size_m;
    object.existence.miss(context.detection_probability * visibility(shown, context.frame.projector,
                                                                     context.frame.view, config_.sigma_px,
                                                                     config_.smallest_object_px));
  }
}

void MovingTracker::note_same_frame_evidence() {
  for (const std::size_t a : active_) {
    for (const std::size_t b : active_) {
      if (a != b && objects_[a].is_seen && objects_[b].is_seen)
        objects_[a].neighbours.seen_apart(objects_[b].track.id);
    }
  }
}

/// What was confirmed was there: not being where it was predicted does not unmake it.
void MovingTracker::remove_improbable(TrackCounters& counters) {
  for (std::size_t k = objects_.size(); k-- > 0;) {
    MovingObject& object = objects_[k];
    const bool is_improbable = object.existence.probability() < config_.delete_probability;
    if (object.is_confirmed()) {
      object.is_lost = object.is_lost || is_improbable;
      if (!object.is_lost) object.track.existence = object.existence.probability();
    } else if (is_improbable || object.is_lost) {
      remove(k);
      ++counters.removed;
    } else {
      object.track.existence = object.existence.probability();
    }
  }
}

bool MovingTracker::are_one(const MovingObject& a, const MovingObject& b) const {
  if (a.is_lost || b.is_lost) return false;
  if (std::min(a.track.hits, b.track.hits) < kHitsToCompare) return false;
  if (a.neighbours.are_apart(b.track.id)) return false;
  const Eigen::Vector4d difference = a.motion.mean - b.motion.mean;
  if (difference.head<2>().norm() > config_.merge_radius_m) return false;
  const Eigen::Matrix4d covariance = a.motion.covariance + b.motion.covariance;
  return difference.dot(covariance.llt().solve(difference)) < kMergeGate;
}

void MovingTracker::merge_duplicates(TrackCounters& counters) {
  for (std::size_t a = 0; a < objects_.size(); ++a) {
    for (std::size_t b = objects_.size(); b-- > a + 1;) {
      if (!are_one(objects_[a], objects_[b])) continue;
      merge(a, b);
      ++counters.merged;
    }
  }
}

/// The older track goes on, with the better estimate of the two.
void MovingTracker::merge(std::size_t kept_row, std::size_t gone_row) {
  MovingObject& kept = objects_[kept_row];
  const MovingObject& gone = objects_[gone_row];
  if (gone.motion.covariance.trace() < kept.motion.covariance.trace()) {
    kept.motion = gone.motion;
    kept.sensitivity = gone.sensitivity;
    kept.track.position_in_enu = gone.track.position_in_enu;
    kept.track.velocity_in_enu = gone.track.velocity_in_enu;
  }
  merge_into(kept, gone);
  for (MovingObject& object : objects_) object.neighbours.rename(gone.track.id, kept.track.id);
  remove(gone_row);
}

void MovingTracker::remove(std::size_t row) {
  objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(row));
}

}  // namespace geoloc
