// SPDX-License-Identifier: Apache-2.0
#include "tracking/joint_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/problems.hpp"
#include "tracking/gaussian.hpp"
#include "tracking/identity.hpp"
#include "tracking/misses.hpp"

namespace geoloc {
namespace {

using Index = CalibrationIndex;

/// Bounds of what the reported accuracy is believed to be wrong by.
constexpr double kLeastWandering = 0.1, kMostWandering = 3.0;
/// Bounds of what a vehicle's reported accuracy is believed to be [m].
constexpr double kLeastAccuracy_m = 0.02, kMostAccuracy_m = 100.0;
/// A known point that is nearer to the image's edge is not covered; share of the image's height.
constexpr double kCoverMargin = 0.1;

JointTrackerConfig checked(const JointTrackerConfig& config) {
  throw_if_any(config.problems());
  return config;
}

PositionAccuracy accuracy_of(const JointTrackerConfig& config) {
  return {config.horizontal_accuracy_m, config.constant_share, config.least_offset_sigma_m};
}

void update_covariances(const ArrowheadSolver::Solution& solution, TrackTable& tracks) {
  for (RestingObject& track : tracks)
    track.track.position_in_enu.covariance = solution.covariance(*track.landmark);
}

}  // namespace

JointTracker::JointTracker(const JointTrackerConfig& config, std::vector<KnownPoint> known_points,
                           int max_detections)
    : config_(checked(config)),
      solver_(config.prior, config.drift.max_nodes),
      errors_(accuracy_of(config), config.drift, solver_),
      noise_clock_(config.fast_time_constant_s, config.attitude_time_constant_s),
      schedule_(config.solve_period_s),
      look_maker_(config_, max_detections),
      look_matcher_(config_, max_detections),
      detection_rate_(config.detection_probability),
      known_points_(std::move(known_points), config.max_tracks),
      tracks_(config.max_tracks),
      moving_(config_, max_detections) {
  published_.reserve((config.moving.classes.empty() ? 1 : 2) * config.max_tracks);
  landmarks_.reserve(config.max_tracks);
  known_candidates_.reserve(config.max_tracks);
}

std::optional<Calibration> JointTracker::calibration_of_camera() const {
  Calibration camera = errors_.calibration;
  const double attitude = config_.sigma_attitude_bias_deg * kRadPerDeg;
  camera.covariance.diagonal().segment<3>(Index::kBoresight).array() += attitude * attitude;
  camera.covariance(Index::kLatency, Index::kLatency) +=
      config_.sigma_state_lag_s * config_.sigma_state_lag_s;
  return camera;
}

void JointTracker::update(const LocatedFrame& located) {
  const JointFrame frame = begin_frame(located);
  const FrameLooks& looks = look_maker_.make(located.detections, frame, errors_);
  const FrameNoise noise{looks.frame_noise, frame.repetition.of_position, config_.fast_time_constant_s};
  const Explanation& explanation = look_matcher_.explain(looks.at_rest, noise, frame.time(), tracks_);
  const FrameShift shift{errors_.calibration.offset_m(), frame.drift.head<2>(), explanation.common_shift};

  const bool may_be_twins = weigh_missed(looks.at_rest, frame, shift, config_, detection_rate_, tracks_);
  if (may_be_twins) schedule_.request();
  cover_known_points(located, shift);
  absorb_matched(looks.at_rest, explanation, frame);
  begin_tentative(looks.at_rest, explanation, frame);
  tell_neighbours_apart(looks.at_rest, explanation, errors_, config_.merge_radius_m, tracks_);
  remove_improbable();
  moving_.update(
      looks.moving,
      {frame, shift.correction(), errors_.calibration.covariance.block<2, 2>(Index::kOffset, Index::kOffset),
       detection_rate_.probability()},
      book_);
  if (schedule_.is_due(frame.time())) refine(frame, noise);
  publish();
}

JointFrame JointTracker::begin_frame(const LocatedFrame& located) {
  const VehicleState& vehicle = located.view.vehicle;
  if (vehicle.sigma_horizontal_m)
    errors_.accuracy.radial_m = std::clamp(*vehicle.sigma_horizontal_m, kLeastAccuracy_m, kMostAccuracy_m);
  schedule_.count_frame();
  tracks_.clear_evidence();
  DriftTimeline& drift = errors_.drift;
  const NodeSpan span = drift.cover(vehicle.time, errors_.accuracy.wandering_sigma_m());
  while (drift.size() > config_.drift.max_nodes) {
    for (RestingObject& track : tracks_) track.landmark->freeze(drift.begin(), drift);
    drift.freeze_oldest();
  }
  return {located.projector, located.view, span, drift.at(span), noise_clock_.tick(vehicle.time)};
}

void JointTracker::cover_known_points(const LocatedFrame& frame, const FrameShift& shift) {
  const Projector& projector = frame.projector;
  const double margin_px = kCoverMargin * projector.camera().intrinsics().height_px;
  known_points_.cover(frame.local_frame, [&](const Eigen::Vector2d& position_in_enu) {
    return projector.sees(shift.shown(position_in_enu), frame.view.enu_from_camera, margin_px);
  });
}

void JointTracker::absorb_matched(const std::vector<Look>& looks, const Explanation& explanation,
                                  const JointFrame& frame) {
  const double found = detection_rate_.probability();
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const JointAssociation::Match& match = explanation.match_of_look[i];
    if (!match.is_certain()) continue;
    RestingObject& track = tracks_[*match.track];
    track.existence.hit(found, density(match.innovation, match.innovation_covariance),
                        looks[i].clutter_density);
    record_look(track, looks[i], frame.time(), frame.view.captured_at_host);
    add_to_sums(track, looks[i], errors_);
    confirm_if_probable(track, config_.confirm_probability);
  }
}

void JointTracker::begin_tentative(const std::vector<Look>& looks, const Explanation& explanation,
                                   const JointFrame& frame) {
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (explanation.match_of_look[i].track) continue;
    if (tracks_.is_full()) {
      ++book_.counters.refused;
      continue;
    }
    RestingObject& track = tracks_.append();
    begin_object(track, config_.birth_probability, frame.view.captured_at_host, book_);
    record_look(track, looks[i], frame.time(), frame.view.captured_at_host);
    begin_sums(track, looks[i], errors_);
    track.look = i;
  }
}

void JointTracker::remove_improbable() {
  for (std::size_t k = tracks_.size(); k-- > 0;) {
    Track& track = tracks_[k].track;
    track.existence = tracks_[k].existence.probability();
    if (*track.existence >= config_.delete_probability) continue;
    known_points_.forget(track.id);
    tracks_.remove(k);
    ++book_.counters.removed;
  }
}

void JointTracker::refine(const JointFrame& frame, const FrameNoise& noise) {
  schedule_.begin_solution(frame.time());
  const auto solution = solve(frame);
  if (!solution) return;
  learn_wandering(*solution);
  merge_compatible(*solution, frame, noise);
  update_covariances(*solution, tracks_);
  if (!match_known_points(*solution, noise)) return;
  if (const auto with_known_points = solve(frame)) update_covariances(*with_known_points, tracks_);
}

std::optional<ArrowheadSolver::Solution> JointTracker::solve(const JointFrame& frame) {
  landmarks_.clear();
  for (const RestingObject& track : tracks_) landmarks_.push_back(track.landmark);
  const auto solution = solver_.solve(landmarks_, errors_.offset_sigma_m(), errors_.drift);
  if (!solution) return std::nullopt;
  errors_.take(*solution);
  for (RestingObject& track : tracks_) refresh(track, errors_, frame.span);
  return solution;
}

void JointTracker::learn_wandering(const Solution& solution) {
  if (!schedule_.next_solution_teaches_wandering()) return;
  const auto wandering = solution.observed_wandering(errors_.drift);
  if (wandering) errors_.drift.set_position_scale(std::clamp(*wandering, kLeastWandering, kMostWandering));
}

void JointTracker::merge_compatible(const Solution& solution, const JointFrame& frame,
                                    const FrameNoise& noise) {
  for (std::size_t a = 0; a < tracks_.size(); ++a) {
    for (std::size_t b = a + 1; b < tracks_.size();) {
      if (may_be_one(tracks_[a], tracks_[b], solution, noise, config_)) {
        merge(a, b);
        refresh(tracks_[a], errors_, frame.span);
      } else {
        ++b;
      }
    }
  }
  for (RestingObject& track : tracks_) track.is_compared = track.track.hits >= kHitsToCompare;
}

/// All that is known of `gone` goes to `kept`.
void JointTracker::merge(std::size_t kept_row, std::size_t gone_row) {
  RestingObject& kept = tracks_[kept_row];
  const RestingObject& gone = tracks_[gone_row];
  kept.landmark->merge(*gone.landmark, errors_.drift);
  kept.pixel_information += gone.pixel_information;
  kept.is_known = kept.is_known || gone.is_known;
  merge_into(kept, gone);
  known_points_.rename(gone.track.id, kept.track.id);
  for (RestingObject& track : tracks_) track.neighbours.rename(gone.track.id, kept.track.id);
  tracks_.remove(gone_row);
  ++book_.counters.merged;
}

/// A surveyed object's coordinates are information on its position, and through the head on all others'. True
/// where there is some that the solution does not have.
bool JointTracker::match_known_points(const Solution& solution, const FrameNoise& noise) {
  if (known_points_.is_empty()) return false;
  known_candidates_.clear();
  double variance = 0.0, own_variance = 0.0;  // per axis, sums over the candidates
  const RestingObject* before = nullptr;
  for (const RestingObject& object : tracks_) {
    const Track& track = object.track;
    if (track.hits < kHitsToCompare) continue;
    variance += 0.5 * track.position_in_enu.covariance.trace();
    own_variance += before == nullptr
                        ? 0.5 * object.own_covariance.trace()
                        : 0.25 * covariance_of_difference(*before, object, solution, noise).trace();
    known_candidates_.push_back(
        {track.id, object.is_confirmed(), track.class_id(), track.position_in_enu.mean});
    before = &object;
  }
  if (known_candidates_.empty()) return false;
  const auto count = static_cast<double>(known_candidates_.size());
  const double shared_variance = std::max(0.0, (variance - own_variance) / count);
  const KnownPointMatcher::Sigma sigma{std::sqrt(shared_variance), std::sqrt(own_variance / count)};
  if (!known_points_.match(known_candidates_, sigma, config_.gate, config_.ambiguity)) return false;
  for (RestingObject& object : tracks_) {
    const auto survey = known_points_.survey_of(object.track.id);
    if (!survey || object.is_known) continue;
    object.landmark->add_prior(survey->position_in_enu,
                               Eigen::Matrix2d::Identity() / (survey->sigma_m * survey->sigma_m));
    object.is_known = true;
  }
  return true;
}

void JointTracker::publish() {
  published_.clear();
  const auto& moving = moving_.objects();
  auto next_moving = moving.begin();
  for (const RestingObject& object : tracks_) {
    for (; next_moving != moving.end() && next_moving->track.id < object.track.id; ++next_moving)
      published_.push_back(next_moving->track);
    published_.push_back(object.track);
  }
  for (; next_moving != moving.end(); ++next_moving) published_.push_back(next_moving->track);
}

}  // namespace geoloc
