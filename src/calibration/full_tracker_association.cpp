// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geoloc/calibration/full_tracker.hpp"

// Which look shows which track.
namespace geoloc {
namespace {

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

/// What the looks of this frame may be off by together.
SharedError::Matrix FullTracker::shared_prior() const {
  SharedError::Matrix prior = SharedError::Matrix::Zero();
  prior.block<SharedError::kCalibrationSize, SharedError::kCalibrationSize>(SharedError::kCalibration,
                                                                            SharedError::kCalibration) =
      calibration_.covariance.topLeftCorner<SharedError::kCalibrationSize, SharedError::kCalibrationSize>();
  prior.block<kNodeSize, kNodeSize>(SharedError::kDrift, SharedError::kDrift) =
      solver_.newest_node_covariance();
  prior.block<2, 2>(SharedError::kFrame, SharedError::kFrame) = frame_noise_;
  prior(SharedError::kTime, SharedError::kTime) = std::pow(config_.sigma_time_s, 2);
  return prior;
}

double FullTracker::spread(const SharedError::Row& jacobian) const {
  const auto calibration = jacobian.middleCols<SharedError::kCalibrationSize>(SharedError::kCalibration);
  const auto drift = jacobian.middleCols<kNodeSize>(SharedError::kDrift);
  return (calibration *
          calibration_.covariance
              .topLeftCorner<SharedError::kCalibrationSize, SharedError::kCalibrationSize>() *
          calibration.transpose())
             .trace() +
         (drift * solver_.newest_node_covariance() * drift.transpose()).trace();
}

/// With P = R R', (a - b) P (a - b)' is the square of aR - bR: cheap for every pair of look and track.
void FullTracker::whiten(const SharedError::Matrix& root) {
  for (Look& look : looks_) look.whitened_jacobian = look.jacobian.lazyProduct(root);
  for (Estimate& estimate : estimates_) estimate.whitened_gain = estimate.gain.lazyProduct(root);
}

/// All tracks that the look may show; those that are farther than the trace of the covariance allows are not
/// looked at closely.
void FullTracker::add_pairings(int look_index) {
  const Look& look = looks_[static_cast<std::size_t>(look_index)];
  const double look_bound = look.pixel_noise.trace();
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    const Estimate& estimate = estimates_[k];
    const double distance_squared = (look.position - tracks_[k].position_in_enu.mean).squaredNorm();
    const double bound = look_bound + estimate.own_covariance.trace() + frame_noise_.trace() +
                         (look.whitened_jacobian - estimate.whitened_gain).squaredNorm();
    if (distance_squared < config_.gate * bound) association_.add(pairing(look_index, static_cast<int>(k)));
  }
}

/// Of the noise of two frames.
double FullTracker::shared_share_of_noise(Duration pause) const {
  return std::exp(-std::abs(seconds(pause)) / std::max(config_.fast_time_constant_s, 1e-3));
}

/// Frames within a second share most of their noise: it cancels between a look and a track that was seen just
/// now, and a track seen for a short time only has it whole.
Pairing FullTracker::pairing(int look_index, int track_index) const {
  const Look& look = looks_[static_cast<std::size_t>(look_index)];
  const Track& track = tracks_[static_cast<std::size_t>(track_index)];
  const Estimate& estimate = estimates_[static_cast<std::size_t>(track_index)];
  const double share = noise_share(track);
  const double fresh = 1.0 - share * shared_share_of_noise(now_ - estimate.last_look);

  Pairing pairing;
  pairing.look = look_index;
  pairing.track = track_index;
  pairing.residual = look.position - track.position_in_enu.mean;
  pairing.jacobian = look.jacobian - estimate.gain;
  pairing.jacobian.middleCols<2>(SharedError::kFrame) *= std::sqrt(fresh);
  pairing.own_covariance =
      look.pixel_noise + estimate.pixel_information.inverse() + fresh * share * frame_noise_;
  pairing.penalty = look.detection->class_id == track.class_id() ? 0.0 : config_.class_mismatch_cost;
  return pairing;
}

/// Median of the residuals: what all looks of this frame share.
Eigen::Vector2d FullTracker::common_shift() {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    median_scratch_.clear();
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      const int track = (*matches_)[i].track;
      if (track == JointAssociation::kNone) continue;
      median_scratch_.push_back(looks_[i].position[axis] -
                                tracks_[static_cast<std::size_t>(track)].position_in_enu.mean[axis]);
    }
    if (median_scratch_.size() >= 2) shift[axis] = median(median_scratch_);
  }
  return shift;
}

void FullTracker::associate() {
  const SharedError::Matrix prior = shared_prior();
  constexpr double kTiny = 1e-18;  // for components that are exactly known
  whiten((prior + kTiny * SharedError::Matrix::Identity()).llt().matrixL());
  association_.begin(looks_.size(), prior, config_.gate, config_.ambiguity);
  for (std::size_t i = 0; i < looks_.size(); ++i) add_pairings(static_cast<int>(i));
  matches_ = &association_.solve();
  shift_ = common_shift();
  is_seen_.assign(tracks_.size(), false);
  is_in_doubt_.assign(tracks_.size(), false);
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (is_matched(i)) is_seen_[static_cast<std::size_t>((*matches_)[i].track)] = true;
  }
  for (const Pairing& pairing : association_.pairings()) {
    if ((*matches_)[static_cast<std::size_t>(pairing.look)].is_ambiguous)
      is_in_doubt_[static_cast<std::size_t>(pairing.track)] = true;
  }
}

/// Whether the look shows a track, and no other may be meant.
bool FullTracker::is_matched(std::size_t look) const {
  const JointAssociation::Match& match = (*matches_)[look];
  return match.track != JointAssociation::kNone && !match.is_ambiguous;
}

}  // namespace geoloc
