// SPDX-License-Identifier: Apache-2.0
#include "geoloc/calibration/full_tracker.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/problems.hpp"

namespace geoloc {
namespace {

using Index = CalibrationIndex;

/// Frames at the start of a flight after each of which the head is solved: it learns most then.
constexpr int kEagerFrames = 100;
/// Association: assignment and the frame's common shift are found in turns.
constexpr int kRounds = 3;
/// Looks that make a track worth merging.
constexpr int kMergeHits = 3;
/// What two tracks of one object may differ by beyond their stated noise: its looks differ with the
/// direction.
constexpr double kSigmaSameObject_m = 0.15;
/// The wandering is learnt now and then: it costs a solution, and changes slowly.
constexpr int kSolutionsPerLesson = 5;
/// Bounds of what the reported accuracy is believed to be wrong by.
constexpr double kLeastWandering = 0.1, kMostWandering = 3.0;
/// What the assumed detection probability counts for against observed ones.
constexpr double kPriorOpportunities = 20.0;
/// Looks to remember: the detection probability follows the light and the ground.
constexpr double kMostOpportunities = 2000.0;

/// The offset cancels between a look and a track that looks made.
constexpr int kRelative = Index::kOffset;

double spread(const Landmark::CalibrationRow& row, const CalibrationMatrix& covariance) {
  const auto relative = row.leftCols<kRelative>();
  return (relative * covariance.topLeftCorner<kRelative, kRelative>() * relative.transpose()).trace();
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of detection, as counted; never certain either way.
double counted_probability(double hits, double opportunities) {
  return std::clamp(hits / opportunities, 0.05, 0.98);
}

FullTrackerConfig checked(const FullTrackerConfig& config) {
  throw_if_any(config.problems());
  return config;
}

}  // namespace

std::vector<std::string> FullTrackerConfig::problems() const {
  Problems found;
  found.add(prior.problems());
  found.add(drift.problems());
  found.require(sigma_px > 0.0 && sigma_px <= 1000.0, "full.sigma_px must lie in (0, 1000]");
  found.require(sigma_attitude_deg > 0.0 && sigma_attitude_deg <= 30.0,
                "full.sigma_attitude_deg must lie in (0, 30]");
  found.require(horizontal_accuracy_m > 0.0 && horizontal_accuracy_m <= 1000.0,
                "full.horizontal_accuracy_m must lie in (0, 1000]");
  found.require(least_offset_sigma_m >= 0.0 && least_offset_sigma_m <= 1000.0,
                "full.least_offset_sigma_m must lie in [0, 1000]");
  found.require(constant_share >= 0.0 && constant_share < 1.0, "full.constant_share must lie in [0, 1)");
  found.require(sigma_attitude_bias_deg >= 0.0 && sigma_attitude_bias_deg <= 30.0,
                "full.sigma_attitude_bias_deg must lie in [0, 30]");
  found.require(sigma_state_lag_s >= 0.0 && sigma_state_lag_s <= 1.0,
                "full.sigma_state_lag_s must lie in [0, 1]");
  found.require(fast_share >= 0.0 && fast_share <= 1.0, "full.fast_share must lie in [0, 1]");
  found.require(fast_time_constant_s >= 0.0 && fast_time_constant_s <= 100.0,
                "full.fast_time_constant_s must lie in [0, 100]");
  found.require(gate > 0.0 && gate <= 1000.0, "full.gate must lie in (0, 1000]");
  found.require(class_mismatch_cost >= 0.0, "full.class_mismatch_cost must be >= 0");
  found.require(duplicate_share >= 0.0 && duplicate_share <= 1.0, "full.duplicate_share must lie in [0, 1]");
  for (const double probability :
       {detection_probability, birth_probability, confirm_probability, delete_probability}) {
    found.require(probability > 0.0 && probability < 1.0, "full probabilities must lie in (0, 1)");
  }
  found.require(clutter_per_frame > 0.0 && clutter_per_frame <= 1000.0,
                "full.clutter_per_frame must lie in (0, 1000]");
  found.require(smallest_object_px >= 0.0, "full.smallest_object_px must be >= 0");
  found.require(merge_radius_m >= 0.0 && merge_radius_m <= 1000.0,
                "full.merge_radius_m must lie in [0, 1000]");
  found.require(merge_gate > 0.0 && merge_gate <= 1000.0, "full.merge_gate must lie in (0, 1000]");
  found.require(max_tracks >= 1 && max_tracks <= 20000, "full.max_tracks must lie in [1, 20000]");
  found.require(solve_period_s >= 0.0 && solve_period_s <= 60.0, "full.solve_period_s must lie in [0, 60]");
  return found.take();
}

FullTracker::FullTracker(const FullTrackerConfig& config, int max_detections)
    : config_(checked(config)),
      drift_(config.drift),
      solver_(config.prior, config.drift.max_nodes),
      reported_accuracy_m_(config.horizontal_accuracy_m),
      expected_hits_(config.detection_probability * kPriorOpportunities),
      opportunities_(kPriorOpportunities) {
  const auto tracks = static_cast<std::size_t>(config.max_tracks);
  const auto looks = static_cast<std::size_t>(max_detections);
  tracks_.reserve(tracks);
  estimates_.reserve(tracks);
  landmarks_.reserve(tracks);
  free_landmarks_.reserve(tracks);
  all_landmarks_.reserve(tracks);
  candidates_.reserve(tracks);
  look_of_track_.reserve(tracks);
  detection_probability_of_track_.reserve(tracks);
  looks_.reserve(looks);
  track_of_look_.reserve(looks);
  median_scratch_.reserve(looks);
  costs_.resize(max_detections, config.max_tracks);
  assignment_.reserve(max_detections, config.max_tracks);
  calibration_.mean = solver_.prior_mean();
  calibration_.covariance = solver_.prior_sigma(sigma_offset_m()).array().square().matrix().asDiagonal();
}

/// Of the wandering, an axis; the reported accuracy is radial.
double FullTracker::reported_sigma_m() const {
  return std::sqrt(0.5 * (1.0 - config_.constant_share)) * reported_accuracy_m_;
}

/// A receiver that wanders less than it reports is taken to be as much better in what no look can show.
double FullTracker::sigma_offset_m() const {
  const double sigma_m = std::sqrt(0.5 * config_.constant_share) * reported_accuracy_m_;
  return std::max(config_.least_offset_sigma_m, drift_.position_scale() * sigma_m);
}

Calibration FullTracker::calibration_of_camera() const {
  Calibration camera = calibration_;
  const double attitude = config_.sigma_attitude_bias_deg * kRadPerDeg;
  camera.covariance.diagonal().segment<3>(Index::kBoresight).array() += attitude * attitude;
  camera.covariance(Index::kLatency, Index::kLatency) +=
      config_.sigma_state_lag_s * config_.sigma_state_lag_s;
  return camera;
}

void FullTracker::update(const std::vector<LocatedDetection>& detections, const Projector& projector,
                         const FrameView& view) {
  begin_frame(view);
  make_looks(detections, projector, view);
  associate();
  weigh_missed(projector, view);
  note_same_frame_evidence();
  absorb_matched(view.captured_at_host);
  start_tentative(view.captured_at_host);
  remove_improbable();
  solve_if_due(view.vehicle.time);
}

void FullTracker::begin_frame(const FrameView& view) {
  ++frames_;
  if (view.vehicle.sigma_horizontal_m)
    reported_accuracy_m_ = std::clamp(*view.vehicle.sigma_horizontal_m, 0.02, 100.0);
  if (previous_frame_) {
    const double pause_s = seconds(view.vehicle.time - *previous_frame_);
    if (pause_s > 0.0) noise_correlation_ = std::max(1.0, 2.0 * config_.fast_time_constant_s / pause_s);
  }
  previous_frame_ = view.vehicle.time;
  span_ = drift_.cover(view.vehicle.time, reported_sigma_m());
  while (drift_.size() > config_.drift.max_nodes) {
    for (const Estimate& estimate : estimates_) landmarks_[estimate.landmark].freeze(drift_.begin(), drift_);
    drift_.freeze_oldest();
  }
  drift_now_ = (1.0 - span_.weight_of_second) * drift_.node(span_.first).mean +
               span_.weight_of_second * drift_.node(span_.first + 1).mean;
}

void FullTracker::make_looks(const std::vector<LocatedDetection>& detections, const Projector& projector,
                             const FrameView& view) {
  looks_.clear();
  const double height_m =
      view.enu_from_camera.translation.z() - projector.config().ground_height_above_home_m;
  const double attitude_variance = std::pow(config_.sigma_attitude_deg * kRadPerDeg, 2);
  const double fast_variance =
      std::pow(config_.fast_share * drift_.position_scale() * reported_accuracy_m_, 2) / 2.0;
  const CameraIntrinsics& camera = projector.camera().intrinsics();
  // What the fix already holds: all but the offset.
  CalibrationVector applied = calibration_.mean;
  applied.segment<2>(Index::kOffset).setZero();

  for (const LocatedDetection& located : detections) {
    const FixJacobians jacobians = jacobians_of(located.fix, view, height_m);
    const auto turn = jacobians.calibration.middleCols<3>(Index::kBoresight);
    const Eigen::Matrix2d pixel_noise = located.fix.covariance(config_.sigma_px);
    const Eigen::Matrix2d frame_noise =
        attitude_variance * turn * turn.transpose() + fast_variance * Eigen::Matrix2d::Identity();
    const double ground_per_pixel_m2 = std::abs(located.fix.ground_from_pixel.determinant());

    Look look;
    look.observation.value = located.fix.position_in_enu - jacobians.calibration * applied;
    look.observation.calibration_jacobian = jacobians.calibration;
    look.observation.node_jacobian = jacobians.node;
    look.observation.span = span_;
    look.observation.information = (pixel_noise + noise_correlation_ * frame_noise).inverse();
    look.position = located.fix.position_in_enu + calibration_.offset_m() + jacobians.node * drift_now_;
    look.gate_covariance = pixel_noise + frame_noise + solver_.newest_node_covariance().topLeftCorner<2, 2>();
    look.spread = spread(jacobians.calibration, calibration_.covariance);
    look.clutter_density =
        config_.clutter_per_frame / (ground_per_pixel_m2 * camera.width_px * camera.height_px);
    look.size_m =
        std::sqrt(ground_per_pixel_m2) * std::min(located.detection.box.width, located.detection.box.height);
    look.detection = &located.detection;
    if (!is_duplicate(look)) looks_.push_back(look);
  }
}

/// A detector that fires twice on one object: the more confident box came first.
bool FullTracker::is_duplicate(const Look& look) const {
  return std::any_of(looks_.begin(), looks_.end(), [&](const Look& kept) {
    return kept.detection->class_id == look.detection->class_id &&
           (kept.position - look.position).norm() <
               config_.duplicate_share * std::min(kept.size_m, look.size_m);
  });
}

std::optional<Eigen::Matrix2d> FullTracker::innovation_covariance(const Look& look, const Estimate& estimate,
                                                                  const Eigen::Vector2d& residual) const {
  const double bound =
      look.gate_covariance.trace() + estimate.own_covariance.trace() +
      2.0 * (look.spread + estimate.gain_spread);  // tr((a-b) P (a-b)') <= 2 (tr a P a' + tr b P b')
  if (!(residual.squaredNorm() < config_.gate * bound)) return std::nullopt;
  const auto difference =
      (look.observation.calibration_jacobian - estimate.gain).leftCols<kRelative>().eval();
  return look.gate_covariance + estimate.own_covariance +
         difference * calibration_.covariance.topLeftCorner<kRelative, kRelative>() * difference.transpose();
}

void FullTracker::fill_costs(const Eigen::Vector2d& shift) {
  const auto rows = static_cast<Eigen::Index>(looks_.size());
  candidates_.clear();
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(candidates_.size());
    bool within_gate = false;
    for (Eigen::Index i = 0; i < rows; ++i) {
      const Look& look = looks_[static_cast<std::size_t>(i)];
      const Eigen::Vector2d residual = look.position - shift - tracks_[k].position_in_enu.mean;
      const auto covariance = innovation_covariance(look, estimates_[k], residual);
      costs_(i, column) = config_.gate;
      if (!covariance) continue;
      costs_(i, column) = mahalanobis_squared(residual, *covariance);
      if (look.detection->class_id != tracks_[k].class_id()) costs_(i, column) += config_.class_mismatch_cost;
      within_gate = within_gate || costs_(i, column) < config_.gate;
    }
    if (within_gate) candidates_.push_back(k);  // otherwise the next track takes this column
  }
}

/// Median of the residuals: what all looks of this frame share.
Eigen::Vector2d FullTracker::common_shift() {
  Eigen::Vector2d shift;
  for (int axis = 0; axis < 2; ++axis) {
    median_scratch_.clear();
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      if (track_of_look_[i] == AssignmentSolver::kUnassigned) continue;
      const Track& track = tracks_[static_cast<std::size_t>(track_of_look_[i])];
      median_scratch_.push_back(looks_[i].position[axis] - track.position_in_enu.mean[axis]);
    }
    shift[axis] = median(median_scratch_);
  }
  return shift;
}

void FullTracker::associate() {
  shift_.setZero();
  const auto rows = static_cast<Eigen::Index>(looks_.size());
  for (int round = 0; round < kRounds; ++round) {
    fill_costs(shift_);
    const auto& column_of_row = assignment_.solve(
        costs_.topLeftCorner(rows, static_cast<Eigen::Index>(candidates_.size())), config_.gate);
    track_of_look_.assign(looks_.size(), AssignmentSolver::kUnassigned);
    int pairs = 0;
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      if (column_of_row[i] == AssignmentSolver::kUnassigned) continue;
      track_of_look_[i] = static_cast<int>(candidates_[static_cast<std::size_t>(column_of_row[i])]);
      ++pairs;
    }
    if (pairs < 2) break;
    const Eigen::Vector2d shift = common_shift();
    const bool is_settled = (shift - shift_).norm() < 0.02;  // far below what tells objects apart
    shift_ = shift;
    if (is_settled) break;
  }
  look_of_track_.assign(tracks_.size(), AssignmentSolver::kUnassigned);
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (track_of_look_[i] == AssignmentSolver::kUnassigned) continue;
    look_of_track_[static_cast<std::size_t>(track_of_look_[i])] = static_cast<int>(i);
  }
}

void FullTracker::note_same_frame_evidence() {
  const double reach_m = 2.0 * config_.merge_radius_m;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (track_of_look_[i] == AssignmentSolver::kUnassigned) continue;
    const auto matched = static_cast<std::size_t>(track_of_look_[i]);
    for (std::size_t other = 0; other < tracks_.size(); ++other) {
      const Eigen::Vector2d apart =
          tracks_[other].position_in_enu.mean - tracks_[matched].position_in_enu.mean;
      if (other == matched || apart.squaredNorm() > reach_m * reach_m) continue;
      if (look_of_track_[other] != AssignmentSolver::kUnassigned) {
        estimates_[matched].neighbours.seen_apart(tracks_[other].id);
      } else if (detection_probability_of_track_[other] > 0.0) {
        estimates_[matched].neighbours.seen_as_one(tracks_[other].id);
        estimates_[other].neighbours.seen_as_one(tracks_[matched].id);
      }
    }
  }
}

/// Zero outside the image, at its edge and for objects too small; otherwise what was counted so far.
double FullTracker::detection_probability(std::size_t track, const Projector& projector,
                                          const FrameView& view) const {
  // Where this frame would show it: corrections undone.
  const Eigen::Vector2d shown =
      tracks_[track].position_in_enu.mean - calibration_.offset_m() - drift_now_.head<2>() + shift_;
  const auto pixel = projector.reproject(shown, view.enu_from_camera);
  if (!pixel) return 0.0;
  const auto fix = projector.project(*pixel, view.enu_from_camera);
  if (!fix) return 0.0;
  const double pixel_per_m = 1.0 / std::sqrt(std::abs(fix->ground_from_pixel.determinant()));
  const double size_px = estimates_[track].size_m * pixel_per_m;
  const double sigma_px =
      std::sqrt(estimates_[track].own_covariance.trace() + estimates_[track].gain_spread) * pixel_per_m;
  const double margin_px = 0.6 * size_px + 2.0 * std::min(sigma_px, size_px) + 2.0 * config_.sigma_px;
  if (!projector.camera().contains(*pixel, margin_px)) return 0.0;
  const double seen_well = std::clamp(size_px / std::max(config_.smallest_object_px, 1e-9) - 1.0, 0.0, 1.0);
  return seen_well * counted_probability(expected_hits_, opportunities_);
}

void FullTracker::weigh_missed(const Projector& projector, const FrameView& view) {
  detection_probability_of_track_.assign(tracks_.size(), 0.0);
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    const bool is_matched = look_of_track_[k] != AssignmentSolver::kUnassigned;
    if (is_matched && tracks_[k].status != TrackStatus::kConfirmed) continue;
    const double probability = detection_probability(k, projector, view);
    if (probability <= 0.0) continue;
    detection_probability_of_track_[k] = probability;
    if (!is_matched) {
      estimates_[k].existence.miss(probability);
      ++tracks_[k].penalty;
    }
    if (tracks_[k].status == TrackStatus::kConfirmed) {
      opportunities_ += 1.0;
      expected_hits_ += is_matched ? 1.0 : 0.0;
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
  estimate.size_m += (look.size_m - estimate.size_m) / (track.hits + 1);
  ++track.hits;
  track.confidence_sum += look.detection->confidence;
  track.class_votes.add(look.detection->class_id, look.detection->confidence);
  refresh(k);
}

/// Position and its derivatives from the sums.
void FullTracker::refresh(std::size_t k) {
  Estimate& estimate = estimates_[k];
  const Landmark& landmark = landmarks_[estimate.landmark];
  estimate.own_covariance = landmark.A().inverse();
  estimate.gain = estimate.own_covariance * landmark.B();
  estimate.gain_spread = spread(estimate.gain, calibration_.covariance);
  tracks_[k].position_in_enu.mean = landmark.position(calibration_.mean, drift_);
}

void FullTracker::absorb_matched(HostTime captured_at) {
  const double found = counted_probability(expected_hits_, opportunities_);
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (track_of_look_[i] == AssignmentSolver::kUnassigned) continue;
    const auto k = static_cast<std::size_t>(track_of_look_[i]);
    const Look& look = looks_[i];
    const Eigen::Vector2d residual = look.position - shift_ - tracks_[k].position_in_enu.mean;
    const auto covariance = innovation_covariance(look, estimates_[k], residual);
    if (!covariance) continue;
    const double likelihood = std::exp(-0.5 * mahalanobis_squared(residual, *covariance)) /
                              (2.0 * kPi * std::sqrt(covariance->determinant()));
    estimates_[k].existence.hit(found, likelihood, look.clutter_density);
    absorb(k, look);
    tracks_[k].last_seen = captured_at;
    tracks_[k].penalty = std::max(0, tracks_[k].penalty - 1);
    if (estimates_[k].existence.probability() >= config_.confirm_probability) {
      tracks_[k].status = TrackStatus::kConfirmed;
    }
  }
}

void FullTracker::start_tentative(HostTime captured_at) {
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (track_of_look_[i] != AssignmentSolver::kUnassigned) continue;
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
    absorb(tracks_.size() - 1, looks_[i]);
    tracks_.back().position_in_enu.covariance =
        looks_[i].gate_covariance + looks_[i].spread * Eigen::Matrix2d::Identity();
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
    remove(k);
    ++counters_.removed;
  }
}

void FullTracker::solve_if_due(VehicleTime now) {
  const bool is_due = frames_ <= kEagerFrames || !solved_at_ || now < *solved_at_ ||
                      seconds(now - *solved_at_) >= config_.solve_period_s;
  if (!is_due) return;
  solved_at_ = now;
  all_landmarks_.clear();
  for (const Estimate& estimate : estimates_) all_landmarks_.push_back(&landmarks_[estimate.landmark]);
  solver_.solve(all_landmarks_, sigma_offset_m(), drift_, calibration_);
  learn_wandering();
  for (std::size_t k = 0; k < tracks_.size(); ++k) refresh(k);
  merge_compatible();
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    tracks_[k].position_in_enu.covariance = solver_.covariance(landmarks_[estimates_[k].landmark], drift_);
  }
}

void FullTracker::learn_wandering() {
  if (++solutions_ % kSolutionsPerLesson != 0) return;
  const auto wandering = solver_.observed_wandering(drift_);
  if (wandering) drift_.set_position_scale(std::clamp(*wandering, kLeastWandering, kMostWandering));
}

void FullTracker::merge_compatible() {
  for (std::size_t a = 0; a < tracks_.size(); ++a) {
    for (std::size_t b = a + 1; b < tracks_.size();) {
      const Eigen::Vector2d apart = tracks_[a].position_in_enu.mean - tracks_[b].position_in_enu.mean;
      const bool is_candidate = apart.squaredNorm() <= config_.merge_radius_m * config_.merge_radius_m &&
                                std::min(tracks_[a].hits, tracks_[b].hits) >= kMergeHits &&
                                !estimates_[a].neighbours.are_apart(tracks_[b].id);
      Landmark& landmark_a = landmarks_[estimates_[a].landmark];
      const Landmark& landmark_b = landmarks_[estimates_[b].landmark];
      if (!is_candidate ||
          mahalanobis_squared(apart, solver_.covariance_of_difference(landmark_a, landmark_b, drift_) +
                                         2.0 * kSigmaSameObject_m * kSigmaSameObject_m *
                                             Eigen::Matrix2d::Identity()) > config_.merge_gate) {
        ++b;
        continue;
      }
      landmark_a.merge(landmark_b, drift_);
      Track& kept = tracks_[a];
      const Track& gone = tracks_[b];
      estimates_[a].existence.merge(estimates_[b].existence);
      estimates_[a].neighbours.merge(estimates_[b].neighbours);
      for (Estimate& estimate : estimates_) estimate.neighbours.rename(gone.id, kept.id);
      merge_records(kept, gone);
      remove(b);
      refresh(a);
      ++counters_.merged;
    }
  }
}

}  // namespace geoloc
