// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "geoloc/tracking/joint_tracker.hpp"

// Which look shows which track.
namespace geoloc {
namespace {

constexpr double kTiny = 1e-18;  // a variance for components that are exactly known

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

/// After each solution.
void JointTracker::find_roots() {
  const auto root = [](auto covariance) {
    covariance.diagonal().array() += kTiny;
    return decltype(covariance)(covariance.llt().matrixL());
  };
  calibration_root_ = root(SharedError::CalibrationMatrix(
      calibration_.covariance.topLeftCorner<SharedError::kCalibrationSize, SharedError::kCalibrationSize>()));
  drift_root_ = root(solver_.newest_node_covariance());
}

/// With C = R R', J C J' is the square of J R: cheap for every pair of look and track.
SharedError::Row JointTracker::whitened(const SharedError::CalibrationRow& by_calibration,
                                        const Eigen::Matrix<double, 2, kNodeSize>& by_drift) const {
  SharedError::Row row = SharedError::Row::Zero();
  row.middleCols<SharedError::kCalibrationSize>(SharedError::kCalibration) =
      by_calibration * calibration_root_;
  row.middleCols<kNodeSize>(SharedError::kDrift) = by_drift * drift_root_;
  return row;
}

/// All tracks that a look may show; those that are farther than the trace of the covariance allows are not
/// looked at closely.
void JointTracker::add_pairings() {
  if (looks_.empty()) return;
  SharedError::Row mean = SharedError::Row::Zero();
  for (const Look& look : looks_) mean += look.jacobian;
  mean /= static_cast<double>(looks_.size());
  const double frame_variance = frame_noise_.trace();
  reach_of_track_.clear();
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    reach_of_track_.push_back({tracks_[k].position_in_enu.mean,
                               estimates_[k].own_covariance.trace() + frame_variance,
                               (estimates_[k].gain - mean).norm()});
  }
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const Reach look{looks_[i].position, looks_[i].pixel_noise.trace(), (looks_[i].jacobian - mean).norm()};
    for (std::size_t k = 0; k < tracks_.size(); ++k) {
      const Reach& track = reach_of_track_[k];
      const double shared_m = look.shared_m + track.shared_m;
      const double variance = look.own_variance + track.own_variance + shared_m * shared_m;
      if ((look.position - track.position).squaredNorm() < config_.gate * variance)
        association_.add(pairing(i, k));
    }
  }
}

/// Of the noise of two frames.
double JointTracker::shared_share_of_noise(Duration pause) const {
  return std::exp(-std::abs(seconds(pause)) / std::max(config_.fast_time_constant_s, 1e-3));
}

/// Frames within a second share most of their noise: it cancels between a look and a track that was seen just
/// now, and a track seen for a short time only has it whole.
Pairing JointTracker::pairing(std::size_t look_index, std::size_t track_index) const {
  const Look& look = looks_[look_index];
  const Track& track = tracks_[track_index];
  const Estimate& estimate = estimates_[track_index];
  const double share = noise_share(track);
  const double fresh = 1.0 - share * shared_share_of_noise(now_ - estimate.last_look);

  Pairing pairing;
  pairing.look = static_cast<int>(look_index);
  pairing.track = static_cast<int>(track_index);
  pairing.residual = look.position - track.position_in_enu.mean;
  pairing.jacobian = look.jacobian - estimate.gain;
  pairing.jacobian.middleCols<2>(SharedError::kFrame) *= std::sqrt(fresh);
  pairing.own_covariance =
      look.pixel_noise + estimate.pixel_information.inverse() + fresh * share * frame_noise_;
  pairing.penalty = look.detection->class_id == track.class_id() ? 0.0 : config_.class_mismatch_cost;
  return pairing;
}

/// Median of the residuals: what all looks of this frame share.
Eigen::Vector2d JointTracker::common_shift() {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    median_scratch_.clear();
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      const int track = matches_[i].track;
      if (track == JointAssociation::kNone) continue;
      median_scratch_.push_back(looks_[i].position[axis] -
                                tracks_[static_cast<std::size_t>(track)].position_in_enu.mean[axis]);
    }
    if (median_scratch_.size() >= 2) shift[axis] = median(median_scratch_);
  }
  return shift;
}

/// A look that may show either of two tracks, which no other look of the frame can show and no frame has
/// shown side by side, shows one object that was begun twice: the look is the older one's, and the younger
/// one dies of being missed. Otherwise both would be in doubt for ever, and learn nothing.
void JointTracker::prefer_older_twins() {
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (!matches_[i].is_ambiguous) continue;
    if (const Pairing* const oldest = oldest_twin(i)) matches_[i] = JointAssociation::match_of(*oldest);
  }
}

/// Among the pairs of this look; none where they are not twins.
const Pairing* JointTracker::oldest_twin(std::size_t look) const {
  const auto is_of_look = [&](const Pairing& pairing) { return pairing.look == static_cast<int>(look); };
  const Pairing* oldest = nullptr;
  for (const Pairing& pairing : association_.pairings()) {
    if (!is_of_look(pairing)) continue;
    if (association_.looks_at(pairing.track) > 1) return nullptr;
    if (oldest == nullptr || is_older(pairing.track, oldest->track)) oldest = &pairing;
  }
  if (oldest == nullptr) return nullptr;
  int twins = 0;
  const Neighbours& neighbours = estimates_[static_cast<std::size_t>(oldest->track)].neighbours;
  for (const Pairing& pairing : association_.pairings()) {
    if (!is_of_look(pairing) || pairing.track == oldest->track) continue;
    const Track& twin = tracks_[static_cast<std::size_t>(pairing.track)];
    if (twin.hits >= kHitsToCompare || neighbours.are_apart(twin.id)) return nullptr;
    ++twins;
  }
  return twins > 0 ? oldest : nullptr;
}

bool JointTracker::is_older(int track, int other) const {
  const Track &a = tracks_[static_cast<std::size_t>(track)], &b = tracks_[static_cast<std::size_t>(other)];
  return std::make_tuple(a.status == TrackStatus::kConfirmed, a.hits, b.id) >
         std::make_tuple(b.status == TrackStatus::kConfirmed, b.hits, a.id);
}

void JointTracker::associate() {
  association_.begin(looks_.size(), config_.gate, config_.ambiguity);
  add_pairings();
  matches_ = association_.solve();
  prefer_older_twins();
  shift_ = common_shift();
  look_of_track_.assign(tracks_.size(), JointAssociation::kNone);
  is_in_doubt_.assign(tracks_.size(), false);
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (is_matched(i)) look_of_track_[static_cast<std::size_t>(matches_[i].track)] = static_cast<int>(i);
  }
  for (const Pairing& pairing : association_.pairings()) {
    if (matches_[static_cast<std::size_t>(pairing.look)].is_ambiguous)
      is_in_doubt_[static_cast<std::size_t>(pairing.track)] = true;
  }
}

/// Whether the look shows a track, and no other may be meant.
bool JointTracker::is_matched(std::size_t look) const {
  const JointAssociation::Match& match = matches_[look];
  return match.track != JointAssociation::kNone && !match.is_ambiguous;
}

}  // namespace geoloc
