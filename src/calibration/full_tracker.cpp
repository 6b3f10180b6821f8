// SPDX-License-Identifier: Apache-2.0
#include "geoloc/calibration/full_tracker.hpp"

#include <Eigen/Cholesky>
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
/// Looks that make a track worth merging with others, or comparing with known points.
constexpr int kMergeHits = 3;
/// What two tracks of one object may differ by beyond their stated noise: its looks differ with the
/// direction.
constexpr double kSigmaSameObject_m = 0.15;
/// The wandering is learnt now and then: it costs as much as a solution. Often at first, until it has
/// settled.
constexpr int kSolutionsToSettle = 200, kSolutionsPerLesson = 2, kSolutionsPerLessonLater = 10;
/// Bounds of what the reported accuracy is believed to be wrong by.
constexpr double kLeastWandering = 0.1, kMostWandering = 3.0;
/// What the assumed detection probability counts for against observed ones.
constexpr double kPriorOpportunities = 20.0;
/// Looks to remember: the detection probability follows the light and the ground.
constexpr double kMostOpportunities = 2000.0;

/// The offset cancels between a look and a track that looks made.
constexpr int kRelative = Index::kOffset;

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
  found.require(sigma_time_s >= 0.0 && sigma_time_s <= 1.0, "full.sigma_time_s must lie in [0, 1]");
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
  found.require(ambiguity >= 0.0 && ambiguity <= 1000.0, "full.ambiguity must lie in [0, 1000]");
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

FullTracker::FullTracker(const FullTrackerConfig& config, std::vector<KnownPoint> known_points,
                         int max_detections)
    : config_(checked(config)),
      drift_(config.drift),
      solver_(config.prior, config.drift.max_nodes),
      known_points_(std::move(known_points), config.max_tracks),
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
  is_seen_.reserve(tracks);
  is_in_doubt_.reserve(tracks);
  detection_probability_of_track_.reserve(tracks);
  looks_.reserve(looks);
  median_scratch_.reserve(looks);
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
  cover_known_points(projector, view);
  absorb_matched(view.captured_at_host);
  start_tentative(view.captured_at_host);
  note_same_frame_evidence();
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
  now_ = view.vehicle.time;
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
  frame_noise_.setZero();
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
    const Eigen::Vector2d ground_velocity = jacobians.calibration.col(Index::kLatency);
    const Eigen::Matrix2d pixel_noise = located.fix.covariance(config_.sigma_px);
    const Eigen::Matrix2d time_noise =
        std::pow(config_.sigma_time_s, 2) * ground_velocity * ground_velocity.transpose();
    const Eigen::Matrix2d frame_noise =
        attitude_variance * turn * turn.transpose() + fast_variance * Eigen::Matrix2d::Identity();
    const double ground_per_pixel_m2 = std::abs(located.fix.ground_from_pixel.determinant());

    Look look;
    look.observation.value = located.fix.position_in_enu - jacobians.calibration * applied;
    look.observation.calibration_jacobian = jacobians.calibration;
    look.observation.node_jacobian = jacobians.node;
    look.observation.span = span_;
    look.observation.information = (pixel_noise + time_noise + noise_correlation_ * frame_noise).inverse();
    look.position = located.fix.position_in_enu + calibration_.offset_m() + jacobians.node * drift_now_;
    look.pixel_noise = pixel_noise;
    look.jacobian << jacobians.calibration.leftCols<kRelative>(), jacobians.node, Eigen::Matrix2d::Identity(),
        ground_velocity;
    look.spread = spread(look.jacobian);
    look.clutter_density =
        config_.clutter_per_frame / (ground_per_pixel_m2 * camera.width_px * camera.height_px);
    look.size_m =
        std::sqrt(ground_per_pixel_m2) * std::min(located.detection.box.width, located.detection.box.height);
    look.detection = &located.detection;
    if (is_duplicate(look)) continue;
    looks_.push_back(look);
    frame_noise_ += frame_noise;
  }
  if (!looks_.empty()) frame_noise_ /= static_cast<double>(looks_.size());
}

/// A detector that fires twice on one object: the more confident box came first.
bool FullTracker::is_duplicate(const Look& look) const {
  return std::any_of(looks_.begin(), looks_.end(), [&](const Look& kept) {
    return kept.detection->class_id == look.detection->class_id &&
           (kept.position - look.position).norm() <
               config_.duplicate_share * std::min(kept.size_m, look.size_m);
  });
}

/// What the looks of this frame may be off by together.
SharedError::Matrix FullTracker::shared_prior() const {
  SharedError::Matrix prior = SharedError::Matrix::Zero();
  prior.block<kRelative, kRelative>(SharedError::kCalibration, SharedError::kCalibration) =
      calibration_.covariance.topLeftCorner<kRelative, kRelative>();
  prior.block<kNodeSize, kNodeSize>(SharedError::kDrift, SharedError::kDrift) =
      solver_.newest_node_covariance();
  prior.block<2, 2>(SharedError::kFrame, SharedError::kFrame) = frame_noise_;
  prior(SharedError::kTime, SharedError::kTime) = std::pow(config_.sigma_time_s, 2);
  return prior;
}

double FullTracker::spread(const SharedError::Row& jacobian) const {
  const auto calibration = jacobian.middleCols<kRelative>(SharedError::kCalibration);
  const auto drift = jacobian.middleCols<kNodeSize>(SharedError::kDrift);
  return (calibration * calibration_.covariance.topLeftCorner<kRelative, kRelative>() *
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

/// Frames within a second share most of their noise: it cancels between a look and a track that was seen just
/// now, and a track seen for a short time only has it whole.
Pairing FullTracker::pairing(int look_index, int track_index) const {
  const Look& look = looks_[static_cast<std::size_t>(look_index)];
  const Track& track = tracks_[static_cast<std::size_t>(track_index)];
  const Estimate& estimate = estimates_[static_cast<std::size_t>(track_index)];
  const double share = noise_share(track);
  const double pause_s = seconds(now_ - estimate.last_look);
  const double fresh = 1.0 - share * std::exp(-pause_s / std::max(config_.fast_time_constant_s, 1e-3));

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

/// Two tracks that two looks of one frame made, or were matched to, are two objects.
void FullTracker::note_same_frame_evidence() {
  const double reach_m = 2.0 * config_.merge_radius_m;
  for (std::size_t seen = 0; seen < tracks_.size(); ++seen) {
    if (!is_seen_[seen]) continue;
    for (std::size_t other = 0; other < tracks_.size(); ++other) {
      const Eigen::Vector2d apart = tracks_[other].position_in_enu.mean - tracks_[seen].position_in_enu.mean;
      if (other == seen || apart.squaredNorm() > reach_m * reach_m) continue;
      if (is_seen_[other]) {
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

/// Zero outside the image, at its edge and for objects too small; otherwise what was counted so far.
double FullTracker::detection_probability(std::size_t track, const Projector& projector,
                                          const FrameView& view) const {
  const Eigen::Vector2d shown = shown_in_frame(tracks_[track].position_in_enu.mean);
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
    if (is_in_doubt_[k]) continue;
    const bool is_seen = is_seen_[k];
    if (is_seen && tracks_[k].status != TrackStatus::kConfirmed) continue;
    const double probability = detection_probability(k, projector, view);
    if (probability <= 0.0) continue;
    detection_probability_of_track_[k] = probability;
    if (!is_seen) {
      estimates_[k].existence.miss(probability);
      ++tracks_[k].penalty;
    }
    if (tracks_[k].status == TrackStatus::kConfirmed) {
      opportunities_ += 1.0;
      expected_hits_ += is_seen ? 1.0 : 0.0;
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
  estimate.gain.leftCols<kRelative>() = estimate.own_covariance * landmark.B().leftCols<kRelative>();
  estimate.gain.middleCols<kNodeSize>(SharedError::kDrift) = estimate.own_covariance * recent_drift(landmark);
  estimate.gain_spread = spread(estimate.gain);
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
    is_seen_.push_back(true);
    detection_probability_of_track_.push_back(0.0);
    absorb(tracks_.size() - 1, looks_[i]);
    tracks_.back().position_in_enu.covariance =
        looks_[i].pixel_noise + frame_noise_ + looks_[i].spread * Eigen::Matrix2d::Identity();
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

void FullTracker::solve_if_due(VehicleTime now) {
  const bool is_due = frames_ <= kEagerFrames || !solved_at_ || now < *solved_at_ ||
                      seconds(now - *solved_at_) >= config_.solve_period_s;
  if (!is_due) return;
  solved_at_ = now;
  solve();
  learn_wandering();
  merge_compatible();
  state_covariances();
  if (!match_known_points()) return;
  solve();
  state_covariances();
}

void FullTracker::solve() {
  all_landmarks_.clear();
  for (const Estimate& estimate : estimates_) all_landmarks_.push_back(&landmarks_[estimate.landmark]);
  solver_.solve(all_landmarks_, sigma_offset_m(), drift_, calibration_);
  for (std::size_t k = 0; k < tracks_.size(); ++k) refresh(k);
}

void FullTracker::state_covariances() {
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    tracks_[k].position_in_enu.covariance = solver_.covariance(landmarks_[estimates_[k].landmark], drift_);
  }
}

void FullTracker::cover_known_points(const Projector& projector, const FrameView& view) {
  const double margin_px = 0.1 * projector.camera().intrinsics().height_px;
  for (std::size_t i = 0; i < known_points_.entries().size(); ++i) {
    const Eigen::Vector2d shown = shown_in_frame(known_points_.entries()[i].position_in_enu);
    if (projector.sees(shown, view.enu_from_camera, margin_px)) known_points_.cover(i);
  }
}

/// A surveyed object's coordinates are information on its position, and through the head on all others'. True
/// where there is some that the last solution did not have.
bool FullTracker::match_known_points() {
  if (known_points_.entries().empty()) return false;
  known_candidates_.clear();
  double variance = 0.0, own_variance = 0.0;  // an axis, means over the candidates
  std::size_t before = 0;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    const Track& track = tracks_[k];
    if (track.hits < kMergeHits) continue;
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
  bool is_new = false;
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    const KnownPoints::Entry* entry = known_points_.of_track(tracks_[k].id);
    if (entry == nullptr || estimates_[k].is_known) continue;
    landmarks_[estimates_[k].landmark].add_prior(
        entry->position_in_enu, Eigen::Matrix2d::Identity() / (entry->sigma_m * entry->sigma_m));
    estimates_[k].is_known = true;
    is_new = true;
  }
  return is_new;
}

void FullTracker::learn_wandering() {
  const int pause = solutions_ < kSolutionsToSettle ? kSolutionsPerLesson : kSolutionsPerLessonLater;
  if (++solutions_ % pause != 0) return;
  const auto wandering = solver_.observed_wandering(drift_);
  if (wandering) drift_.set_position_scale(std::clamp(*wandering, kLeastWandering, kMostWandering));
}

/// Of the difference of two tracks. Their own noise is that of association: the sums count the noise of each
/// frame as often as frames repeat it, which is too much for tracks that the same frames made.
Eigen::Matrix2d FullTracker::covariance_of_difference(std::size_t a, std::size_t b) const {
  const Estimate &first = estimates_[a], &second = estimates_[b];
  const double pause_s = std::abs(seconds(first.last_look - second.last_look));
  const double fresh = 1.0 - std::exp(-pause_s / std::max(config_.fast_time_constant_s, 1e-3));
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
         std::min(tracks_[a].hits, tracks_[b].hits) >= kMergeHits &&
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
