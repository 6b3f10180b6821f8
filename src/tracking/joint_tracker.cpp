// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/joint_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/problems.hpp"

// One frame, the solution, and the known points. joint_tracker_looks.cpp, joint_tracker_association.cpp,
// joint_tracker_identity.cpp and joint_tracker_life_cycle.cpp hold what their names say.
namespace geoloc {
namespace {

using Index = CalibrationIndex;

/// Frames at the start of a flight after each of which the head is solved: it learns most then.
constexpr int kEagerFrames = 100;
/// The wandering is learnt with each solution until it has settled, then now and then: it costs as much as a
/// solution.
constexpr int kSolutionsToSettle = 150, kSolutionsPerLessonLater = 5;
/// Bounds of what the reported accuracy is believed to be wrong by.
constexpr double kLeastWandering = 0.1, kMostWandering = 3.0;
/// What the assumed detection probability counts for against observed ones.
constexpr double kPriorOpportunities = 20.0;

/// By which the variance of a mean over many frames is larger than if their noise was not shared.
double frames_that_share(double time_constant_s, double pause_s) {
  return std::max(1.0, 2.0 * time_constant_s / pause_s);
}

JointTrackerConfig checked(const JointTrackerConfig& config) {
  throw_if_any(config.problems());
  return config;
}

}  // namespace

JointTracker::JointTracker(const JointTrackerConfig& config, std::vector<KnownPoint> known_points,
                           int max_detections)
    : config_(checked(config)),
      drift_(config.drift),
      solver_(config.prior, config.drift.max_nodes),
      known_points_(std::move(known_points), config.max_tracks),
      moving_(config, max_detections),
      reported_accuracy_m_(config.horizontal_accuracy_m),
      association_(max_detections, config.max_tracks),
      expected_hits_(config.detection_probability * kPriorOpportunities),
      opportunities_(kPriorOpportunities) {
  const auto tracks = static_cast<std::size_t>(config.max_tracks);
  const auto looks = static_cast<std::size_t>(max_detections);
  tracks_.reserve(tracks);
  estimates_.reserve(tracks);
  landmarks_.reserve(tracks);
  free_landmarks_.reserve(tracks);
  all_landmarks_.reserve(tracks);
  known_candidates_.reserve(tracks);
  look_of_track_.reserve(tracks);
  reach_of_track_.reserve(tracks);
  is_in_doubt_.reserve(tracks);
  detection_probability_of_track_.reserve(tracks);
  looks_.reserve(looks);
  matches_.reserve(looks);
  if (!config.moving.classes.empty()) {
    moving_looks_.reserve(looks);
    all_tracks_.reserve(2 * tracks);
  }
  median_scratch_.reserve(looks);
  calibration_.mean = solver_.prior_mean();
  calibration_.covariance = solver_.prior_sigma(sigma_offset_m()).array().square().matrix().asDiagonal();
  find_roots();
}

/// Of the wandering, an axis; the reported accuracy is radial.
double JointTracker::reported_sigma_m() const {
  return std::sqrt(0.5 * (1.0 - config_.constant_share)) * reported_accuracy_m_;
}

/// A receiver that wanders less than it reports is taken to be as much better in what no look can show.
double JointTracker::sigma_offset_m() const {
  const double sigma_m = std::sqrt(0.5 * config_.constant_share) * reported_accuracy_m_;
  return std::max(config_.least_offset_sigma_m, drift_.position_scale() * sigma_m);
}

Calibration JointTracker::calibration_of_camera() const {
  Calibration camera = calibration_;
  const double attitude = config_.sigma_attitude_bias_deg * kRadPerDeg;
  camera.covariance.diagonal().segment<3>(Index::kBoresight).array() += attitude * attitude;
  camera.covariance(Index::kLatency, Index::kLatency) +=
      config_.sigma_state_lag_s * config_.sigma_state_lag_s;
  return camera;
}

void JointTracker::update(const std::vector<LocatedDetection>& detections, const Projector& projector,
                          const FrameView& view) {
  begin_frame(view);
  make_looks(detections, projector, view);
  associate();
  weigh_missed(projector, view);
  cover_known_points(projector, view);
  absorb_matched(view.captured_at_host);
  start_tentative(view.captured_at_host);
  note_same_frame_evidence();
  remove_improbable();
  track_moving(projector, view);
  solve_if_due(view.vehicle.time);
  list_all_tracks();
}

void JointTracker::begin_frame(const FrameView& view) {
  if (view.vehicle.sigma_horizontal_m)
    reported_accuracy_m_ = std::clamp(*view.vehicle.sigma_horizontal_m, 0.02, 100.0);
  if (frames_++ > 0) {
    const double pause_s = seconds(view.vehicle.time - now_);
    if (pause_s > 0.0) {
      noise_correlation_ = frames_that_share(config_.fast_time_constant_s, pause_s);
      attitude_correlation_ = frames_that_share(config_.attitude_time_constant_s, pause_s);
    }
  }
  now_ = view.vehicle.time;
  span_ = drift_.cover(view.vehicle.time, reported_sigma_m());
  while (drift_.size() > config_.drift.max_nodes) {
    for (const Estimate& estimate : estimates_) landmarks_[estimate.landmark].freeze(drift_.begin(), drift_);
    drift_.freeze_oldest();
  }
  drift_now_ = (1.0 - span_.weight_of_second) * drift_.node(span_.first).mean +
               span_.weight_of_second * drift_.node(span_.first + 1).mean;
}

void JointTracker::track_moving(const Projector& projector, const FrameView& view) {
  if (config_.moving.classes.empty()) return;
  const Eigen::Matrix2d offset_covariance =
      calibration_.covariance.block<2, 2>(Index::kOffset, Index::kOffset);
  moving_.update(moving_looks_,
                 {projector, view, calibration_.offset_m() + drift_now_.head<2>() - shift_, offset_covariance,
                  counted_detection_probability()},
                 book_);
}

void JointTracker::list_all_tracks() {
  if (config_.moving.classes.empty()) return;
  all_tracks_.resize(tracks_.size() + moving_.tracks().size());
  std::merge(tracks_.begin(), tracks_.end(), moving_.tracks().begin(), moving_.tracks().end(),
             all_tracks_.begin(), [](const Track& a, const Track& b) { return a.id < b.id; });
}

void JointTracker::solve_if_due(VehicleTime now) {
  const bool is_due = is_comparison_due_ || frames_ <= kEagerFrames || !solved_at_ || now < *solved_at_ ||
                      seconds(now - *solved_at_) >= config_.solve_period_s;
  if (!is_due) return;
  solved_at_ = now;
  is_comparison_due_ = false;
  if (!solve()) return;
  learn_wandering();
  merge_compatible();
  state_covariances();
  if (match_known_points() && solve()) state_covariances();
}

bool JointTracker::solve() {
  all_landmarks_.clear();
  for (const Estimate& estimate : estimates_) all_landmarks_.push_back(&landmarks_[estimate.landmark]);
  if (!solver_.solve(all_landmarks_, sigma_offset_m(), drift_, calibration_)) return false;
  find_roots();
  for (std::size_t k = 0; k < tracks_.size(); ++k) refresh(k);
  return true;
}

void JointTracker::state_covariances() {
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    tracks_[k].position_in_enu.covariance = solver_.covariance(landmarks_[estimates_[k].landmark], drift_);
  }
}

void JointTracker::cover_known_points(const Projector& projector, const FrameView& view) {
  const double margin_px = 0.1 * projector.camera().intrinsics().height_px;
  for (std::size_t i = 0; i < known_points_.entries().size(); ++i) {
    const Eigen::Vector2d shown = shown_in_frame(known_points_.entries()[i].position_in_enu);
    if (projector.sees(shown, view.enu_from_camera, margin_px)) known_points_.cover(i);
  }
}

/// A surveyed object's coordinates are information on its position, and through the head on all others'. True
/// where there is some that the last solution did not have.
bool JointTracker::match_known_points() {
  if (known_points_.entries().empty()) return false;
  known_candidates_.clear();
  double variance = 0.0, own_variance = 0.0;  // an axis, means over the candidates
  std::size_t before = 0;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    const Track& track = tracks_[k];
    if (track.hits < kHitsToCompare) continue;
    variance += 0.5 * track.position_in_enu.covariance.trace();
    own_variance += known_candidates_.empty() ? 0.5 * estimates_[k].own_covariance.trace()
                                              : 0.25 * covariance_of_difference(before, k).trace();
    known_candidates_.push_back(
        {track.id, track.status == TrackStatus::kConfirmed, track.class_id(), track.position_in_enu.mean});
    before = k;
  }
  if (known_candidates_.empty()) return false;
  const auto count = static_cast<double>(known_candidates_.size());
  const double shared_variance = std::max(0.0, (variance - own_variance) / count);
  if (!known_points_.match(known_candidates_, std::sqrt(shared_variance), std::sqrt(own_variance / count),
                           config_.gate, config_.ambiguity))
    return false;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    const KnownPoints::Entry* entry = known_points_.of_track(tracks_[k].id);
    if (entry == nullptr || estimates_[k].is_known) continue;
    landmarks_[estimates_[k].landmark].add_prior(
        entry->position_in_enu, Eigen::Matrix2d::Identity() / (entry->sigma_m * entry->sigma_m));
    estimates_[k].is_known = true;
  }
  return true;
}

void JointTracker::learn_wandering() {
  const int pause = solutions_ < kSolutionsToSettle ? 1 : kSolutionsPerLessonLater;
  if (++solutions_ % pause != 0) return;
  const auto wandering = solver_.observed_wandering(drift_);
  if (wandering) drift_.set_position_scale(std::clamp(*wandering, kLeastWandering, kMostWandering));
}

}  // namespace geoloc
