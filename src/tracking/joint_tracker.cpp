// SPDX-License-Identifier: Apache-2.0
#include "tracking/joint_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "geometry/room.hpp"
#include "tracking/false_looks.hpp"
#include "tracking/gaussian.hpp"
#include "tracking/ground_prior.hpp"
#include "tracking/head_bound.hpp"
#include "tracking/identity.hpp"
#include "tracking/joint_estimate.hpp"
#include "tracking/known_places.hpp"
#include "tracking/misses.hpp"
#include "tracking/range_aid.hpp"
#include "tracking/sleep_cycle.hpp"

namespace geoloc {
namespace {

using Index = CalibrationIndex;

/// A known point that is nearer to the image's edge is not covered; share of the image's height.
constexpr double kCoverMargin = 0.1;
/// Sleeping objects that are brought up to date with each frame.
constexpr std::size_t kSleepersPerFrame = 8;
/// Covariances that are brought up to date with each solution, but for those of objects in view.
constexpr std::size_t kCovariancesPerSolution = 48;

JointTrackerConfig checked(const JointTrackerConfig& config) {
  refuse_if_any(config.problems());
  return config;
}

PositionAccuracy accuracy_of(const JointTrackerConfig& config) {
  return {config.horizontal_accuracy_m, config.constant_share, config.stated_offset_sigma_m,
          config.least_offset_sigma_m};
}

/// What looks tell of the focal length is off by so much in flights where it was right (docs/method.md), more
/// than their noise explains: the autopilot's tilts are in it, which the image shows by the focal length.
constexpr double kSigmaOfFoundFocal = 0.006;

/// A camera at this share of the height that its vehicle reports, or lower, stands on the ground.
constexpr double kOnTheGround = 0.1;
/// So often the flight's first looks are explained anew, each time with twice the noise of the attitude.
constexpr int kMostFalseStarts = 2;

/// By what the present latency must explain the flight's earlier frames better than another one that was
/// found for the newest, in log likelihood, for the clock to have stepped in between.
constexpr double kLeastLeadOfStep = 10.0;

/// 1-sigma of a latency that the flight's looks have told.
constexpr double kSigmaOfToldLatency_s = 0.03;

/// 1-sigma of a latency that was found by how the vehicle turned between frames.
constexpr double kSigmaOfFoundLatency_s = 0.1;

double height_above_plane_m(const Projector& projector, const FrameView& view) {
  return view.enu_from_camera.translation.z() - projector.config().ground_height_above_home_m;
}

/// Above the level ground, as the vehicle reports it: of a view that was lifted.
double reported_height_of_lifted_m(const Projector& projector, const FrameView& view) {
  return view.enu_from_camera.translation.z() -
         (projector.config().ground_height_above_home_m + view.lifted_m) - view.terrain_m;
}

/// Where objects move to another slope of the ground, that is what is known of their height.
void follow_ground(const GroundModel& ground, TrackTable& tracks) {
  if (ground.is_level()) return;
  for (RestingObject& track : tracks)
    set_ground(track, ground_prior(ground, track.position_in_enu.head<2>(), 0.0));
}

/// Of those in view, and of others as far as `budget` goes. Returns what is left of it.
std::size_t update_covariances(const ArrowheadSolver::Solution& solution, VehicleTime now, std::size_t budget,
                               TrackTable& tracks) {
  const auto update = [&](RestingObject& track) {
    const PointMatrix covariance = solution.covariance(*track.landmark);
    track.track.position_in_enu.covariance = covariance.topLeftCorner<2, 2>();
    track.sigma_height_m = std::sqrt(covariance(2, 2));
    if (budget > 0) --budget;
  };
  for (RestingObject& track : tracks) {
    if (track.last_near == now) update(track);
  }
  for (RestingObject& track : tracks) {
    if (budget > 0 && track.last_near != now) update(track);
  }
  return budget;
}

}  // namespace

JointTracker::JointTracker(const JointTrackerConfig& config, std::vector<KnownPoint> known_points,
                           int max_detections)
    : config_(checked(config)),
      solver_(config.prior, config.drift),
      errors_(accuracy_of(config), {config.prior.height_m, config.prior.sigma_height_m},
              NoiseEstimate(config.sigma_attitude_deg * kRadPerDeg), config.drift, solver_),
      heights_(config.drift.max_nodes),
      noise_clock_(config.fast_time_constant_s, config.attitude_time_constant_s),
      clock_watch_(most_awake(config)),
      waiting_(max_detections),
      schedule_(config.solve_period_s),
      look_maker_(config_, max_detections),
      look_matcher_(config_, max_detections),
      detection_rate_(config.detection_probability),
      clutter_rate_(config.clutter_per_frame),
      known_points_(std::move(known_points), most_awake(config)),
      surveyed_(most_awake(config)),
      tracks_(most_awake(config)),
      recent_looks_(max_detections),
      moving_(config_, max_detections),
      sleeping_(config.drift, TrackTable::kRowsAtFirst),
      published_(config.max_tracks) {
  take_room(this, config, known_points_.points(), max_detections);
}

/// Its parts have taken theirs.
std::size_t JointTracker::take_room(JointTracker* self, const JointTrackerConfig& config,
                                    const std::vector<KnownPoint>& known_points, int max_detections) {
  const std::size_t max_moving = config.moving.classes.empty() ? 0 : config.max_tracks + most_awake(config);
  return room::bytes_of_copy(config.moving.classes) + ArrowheadSolver::take_room(nullptr, config.drift) +
         DriftTimeline::take_room(nullptr, config.drift) +
         HeightLog::take_room(nullptr, config.drift.max_nodes) + LatencyWatch::take_room(nullptr) +
         ClockWatch::take_room(nullptr, most_awake(config)) +
         WaitingFrames::take_room(nullptr, max_detections) +
         LookMaker::take_room(nullptr, config, max_detections) +
         LookMatcher::take_room(nullptr, config, max_detections) +
         KnownPointMatcher::take_room(nullptr, known_points, most_awake(config)) +
         SurveyedObjects::take_room(nullptr, most_awake(config)) +
         TrackTable::take_room(nullptr, most_awake(config)) + OpeningLooks::take_room(nullptr) +
         RecentLooks::take_room(nullptr, max_detections) +
         MovingTracker::take_room(nullptr, config, max_detections) +
         SleepingObjects::take_room(nullptr, config.drift, TrackTable::kRowsAtFirst) +
         PublishedTracks::take_room(nullptr, config.max_tracks) +
         room::reserve(self, &JointTracker::published_with_moving_, max_moving);
}

std::optional<Calibration> JointTracker::calibration_of_camera() const {
  Calibration camera = errors_.calibration;
  const double attitude = config_.sigma_attitude_bias_deg * kRadPerDeg;
  camera.covariance.diagonal().segment<3>(Index::kBoresight).array() += attitude * attitude;
  camera.covariance(Index::kLatency, Index::kLatency) +=
      config_.sigma_state_lag_s * config_.sigma_state_lag_s;
  camera.covariance(Index::kPositionLag, Index::kPositionLag) +=
      config_.sigma_state_lag_s * config_.sigma_state_lag_s;
  if (camera.has_unknown_focal())
    camera.covariance(Index::kFocal, Index::kFocal) += std::pow(kSigmaOfFoundFocal, 2);
  return camera;
}

std::optional<JointEstimate> JointTracker::estimate(double ground_height_above_home_m) const {
  return joint_estimate({solver_, errors_, heights_, tracks_, sleeping_, published_},
                        ground_height_above_home_m);
}

void JointTracker::update(const LocatedFrame& located) {
  if (is_clock_watched()) {
    watch_clock(located);
    process_in_turn(located);
  } else {
    waiting_.make_room();
    waiting_.add(located, false);
    waiting_.count_newest_as_used();
    process(located);
    proven_at_ = located.view.vehicle.time;
    watch_start(located);
  }
  publish(located.projector, kSleepersPerFrame);
}

/// No other latency was found that explains the frames in doubt better.
void JointTracker::finish(const LocatedFrame& last) {
  waiting_.release();
  while (waiting_.due() > 0) process_next(last);
  publish(last.projector, sleeping_.size());
}

/// Frames wait while the clock is in doubt, and are made up for a few at a time.
void JointTracker::process_in_turn(const LocatedFrame& located) {
  constexpr int kFramesAtOnce = 4;
  while (!waiting_.make_room()) process_next(located);
  const bool is_next = waiting_.due() == 0 && !clock_watch_.holds();
  waiting_.add(located, clock_watch_.holds());
  if (is_next && waiting_.due() == 1) {
    waiting_.count_newest_as_used();
    process(located);
  }
  for (int i = 0; i < kFramesAtOnce && waiting_.due() > 0; ++i) process_next(located);
  if (clock_watch_.proves()) waiting_.drop_used();
}

void JointTracker::process_next(const LocatedFrame& newest) {
  if (const auto frame = waiting_.use_next(newest, errors_)) process(*frame);
}

void JointTracker::process(const LocatedFrame& located) {
  const JointFrame frame = begin_frame(located);
  wake_near(located, frame);
  if (!is_turned(located, frame)) return learn(located, frame);
  ++book_.counters.frames_turned;
  learn(*located.turned, frame.seen_from(located.turned->view));
}

bool JointTracker::is_turned(const LocatedFrame& located, const JointFrame& frame) {
  if (located.turned == nullptr) return false;
  const FrameFit stated = fit(located, frame);
  return is_doubtful(stated) &&
         is_rather_turned(stated, fit(*located.turned, frame.seen_from(located.turned->view)));
}

/// Nothing is learnt yet.
FrameFit JointTracker::fit(const LocatedFrame& located, const JointFrame& frame) {
  const FrameLooks& looks = look_maker_.make(located.detections, frame, errors_);
  const FrameNoise noise = noise_of(looks, frame);
  const Explanation& explanation = look_matcher_.try_to_explain(looks.at_rest, noise, tracks_);
  return fit_of(looks.at_rest, explanation, frame, shift_of(frame, explanation), config_,
                detection_rate_.probability(), tracks_);
}

FrameShift JointTracker::shift_of(const JointFrame& frame, const Explanation& explanation) const {
  return shift_by(errors_.calibration, frame.drift, frame.ground_height_m, explanation.common_shift);
}

FrameNoise JointTracker::noise_of(const FrameLooks& looks, const JointFrame& frame) const {
  return {looks.frame_noise, frame.repetition.of_position, config_.fast_time_constant_s};
}

/// Of confidences that objects have n times as often, false boxes are n times as rare.
void JointTracker::weigh_confidence(FrameLooks& looks) const {
  for (std::vector<Look>* kind : {&looks.at_rest, &looks.moving}) {
    for (Look& look : *kind) {
      look.confidence_ratio = confidence_.ratio(look.detection.confidence);
      look.clutter_density /= look.confidence_ratio;
    }
  }
}

void JointTracker::learn(const LocatedFrame& located, const JointFrame& frame) {
  FrameLooks& looks = look_maker_.make(located.detections, frame, errors_);
  weigh_confidence(looks);
  place_on_ground(looks.moving, located.ground, located.projector.config().max_range_m);
  errors_.is_opening = opening_looks_.is_open();
  opening_looks_.begin_frame(located.stamp, frame, looks.share_attitude);
  const FrameNoise noise = noise_of(looks, frame);
  const Explanation& explanation = look_matcher_.explain(looks.at_rest, noise, tracks_);
  learn_noise(looks.at_rest, explanation);
  const FrameShift shift = shift_of(frame, explanation);

  const bool may_be_twins = weigh_missed(looks.at_rest, frame, shift, config_, detection_rate_, tracks_);
  if (may_be_twins) schedule_.request();
  cover_known_points(located, shift);
  absorb_matched(looks, explanation, frame);
  begin_tentative(looks.at_rest, explanation, located.ground, frame);
  tell_neighbours_apart(looks.at_rest, explanation, errors_, config_.merge_radius_m, tracks_,
                        sleeping_.settled());
  remove_improbable();
  moving_.update(looks.moving,
                 {frame, shift, errors_.calibration.covariance.block<2, 2>(Index::kOffset, Index::kOffset),
                  detection_rate_.probability()},
                 book_);
  if (schedule_.is_due(frame.time())) refine(located, frame, noise);
}

/// The first reading is where the estimate of the height begins: it may be tens of metres from the prior,
/// after a take-off elsewhere.
void JointTracker::measure_height(const LocatedFrame& located, const NodeSpan& now) {
  if (!located.range_m) return;
  const auto reading = height_reading(*located.range_m, located.view.vehicle,
                                      located.projector.config().ground_height_above_home_m, located.ground);
  if (!reading || !agrees(*reading, errors_, now)) {
    ++book_.counters.ranges_refused;
    return;
  }
  const bool is_first = book_.counters.ranges_used++ == 0;
  heights_.add(now, reading->value_m, reading->variance_m2);
  if (is_first && tracks_.size() == 0) errors_.calibration.mean[Index::kHeight] = reading->value_m;
}

bool JointTracker::is_clock_watched() const {
  return config_.prior.sigma_latency_s > 0.0 && !latency_watch_.is_at_start();
}

/// Frames that are stamped with another latency than believed would put everything beside its place, with
/// certainty.
void JointTracker::watch_start(const LocatedFrame& located) {
  if (!(config_.prior.sigma_latency_s > 0.0)) return;
  const auto found = latency_by_turning(located, true);
  if (!found) {
    if (errors_.calibration.sigma(Index::kLatency) < kSigmaOfToldLatency_s) latency_watch_.end_start();
    return;
  }
  clock_watch_.places().clear();  // they were seen with the latency in question
  const ChangeOfLatency change = change_to(*found, located);
  if (change.lead < kLeastLeadOfStep) return begin_anew(*found);
  latency_watch_.end_start();
  go_on_with_latency(*found, change, located);
}

std::optional<LatencyPrior> JointTracker::latency_by_turning(const LocatedFrame& located, bool is_start) {
  const auto latency_s =
      latency_watch_.observe(located.stamp, located.detections,
                             {located.viewer, located.projector, errors_, is_start, located.view.terrain_m});
  if (!latency_s) return std::nullopt;
  return LatencyPrior{*latency_s, kSigmaOfFoundLatency_s};
}

CalibratedViewer JointTracker::viewer_of(const LocatedFrame& located) const {
  return {located.viewer, located.projector, errors_, false, located.view.terrain_m};
}

WatchExpectation JointTracker::expected_of(const LocatedFrame& located) const {
  const double sigma_attitude_rad = std::sqrt(errors_.noise.attitude_variance_rad2());
  const double wandering_m =
      std::hypot(errors_.drift.position_scale() * errors_.accuracy.wandering_sigma_m(),
                 sigma_attitude_rad * height_above_plane_m(located.projector, located.view));
  return {detection_rate_.probability(), clutter_rate_.per_frame(), config_.sigma_px, sigma_attitude_rad,
          wandering_m};
}

ChangeOfLatency JointTracker::change_to(const LatencyPrior& latency, const LocatedFrame& located) {
  const CalibratedViewer viewer = viewer_of(located);
  const WatchExpectation expected = expected_of(located);
  return find_change(waiting_, {errors_.calibration.latency_s(), latency.latency_s},
                     PlaceFit(viewer, expected), clock_watch_.places());
}

/// The same in mid-flight, where a clock has stepped. While frames are held, known objects tell more than
/// pairs of frames, some of which lie on either side of the step.
void JointTracker::watch_clock(const LocatedFrame& located) {
  if (!clock_watch_.is_in_doubt())
    list_places(tracks_, errors_, config_.drift, located, proven_at_, clock_watch_.places());
  const CalibratedViewer viewer = viewer_of(located);
  const WatchExpectation expected = expected_of(located);
  const auto by_places = clock_watch_.observe(located.stamp, located.detections, PlaceFit(viewer, expected));
  const auto by_turning = latency_by_turning(located, false);
  if (clock_watch_.proves()) proven_at_ = located.view.vehicle.time;
  if (by_places) {
    go_on_with_latency(*by_places, change_to(*by_places, located), located);
  } else if (by_turning && !clock_watch_.holds()) {
    clock_watch_.begin_anew();
    go_on_with_latency(*by_turning, change_to(*by_turning, located), located);
  }
}

/// What was seen with a wrong latency from the flight's start on is worth nothing.
void JointTracker::begin_anew(const LatencyPrior& latency) {
  ++book_.counters.latency_changes;
  false_starts_ = 0;
  forget_flight();
  errors_.begin_latency(latency);
  latency_watch_.begin_anew();
  waiting_.drop_used();
}

/// Attitudes far noisier than expected pull the first height down to the ground, where no look contradicts
/// another, and any latency explains them as well.
bool JointTracker::is_false_start(const LocatedFrame& located) const {
  if (!opening_looks_.is_open() || false_starts_ == kMostFalseStarts) return false;
  const double reported_m = reported_height_of_lifted_m(located.projector, located.view);
  return reported_m + errors_.calibration.height_m() < kOnTheGround * reported_m;
}

void JointTracker::start_over() {
  ++false_starts_;
  forget_flight();
}

void JointTracker::forget_flight() {
  while (tracks_.size() > 0) remove(tracks_.size() - 1);
  book_.counters.removed += sleeping_.size();
  sleeping_.clear();
  published_.clear();
  opening_looks_.restart();
  recent_looks_.clear();
  errors_.drift.clear();
  heights_.clear();
  errors_.noise = NoiseEstimate(std::ldexp(config_.sigma_attitude_deg * kRadPerDeg, false_starts_));
  errors_.calibration = solver_.prior(errors_.prior());
  schedule_ = SolutionSchedule(config_.solve_period_s);
}

/// Between the last frame of the present latency and the first one of another.
VehicleTime JointTracker::end_of_latency(std::size_t first_changed, const LocatedFrame& newest) const {
  const VehicleTime last = waiting_.stamp(first_changed - 1).captured_at;
  const VehicleTime next =
      (first_changed < waiting_.size() ? waiting_.stamp(first_changed) : newest.stamp).captured_at;
  return last + (next - last) / 2 - from_seconds(errors_.calibration.latency_s());
}

/// What was known before the latency changed stays known. The frames since are used anew: without their
/// looks, and without what was begun since. Those that may be of either latency are left out.
void JointTracker::go_on_with_latency(const LatencyPrior& latency, const ChangeOfLatency& change,
                                      const LocatedFrame& frame) {
  ++book_.counters.latency_changes;
  while (waiting_.used() < change.first_possible) process_next(frame);
  if (change.first_possible > 0) proven_at_ = end_of_latency(change.first_possible, frame);
  for (std::size_t row = tracks_.size(); row-- > 0;) {
    if (tracks_[row].sums_since > proven_at_) remove(row);
  }
  sleeping_.forget_since(proven_at_, [this](std::uint64_t id) {
    published_.remove(id);
    ++book_.counters.removed;
  });
  recent_looks_.take_out(proven_at_ + Duration{1}, errors_.drift, tracks_);
  opening_looks_.close();  // its frames have the latency of before
  for (std::size_t row = tracks_.size(); row-- > 0;) {
    if (!has_looks(tracks_[row]) && !tracks_[row].is_known) remove(row);  // its earlier ones were false
  }
  if (const auto before =
          solver_.solve(tracks_.landmarks(), errors_.prior(), errors_.drift, heights_, &sleeping_.settled()))
    errors_.take(*before);
  for (RestingObject& track : tracks_) {
    track.landmark->freeze_latency(errors_.calibration.latency_s());
    track.first_look.reset();
    track.height_look.reset();
  }
  sleeping_.freeze_latency(errors_.calibration.latency_s());
  errors_.begin_latency(latency);
  bound_height(frame.projector, frame.view);
  const NodeSpan newest{errors_.drift.end() - 2, 0.0};
  for (RestingObject& track : tracks_) refresh(track, errors_, newest);
  recent_looks_.clear();
  waiting_.use_again_from(change.first_certain);
  schedule_ = SolutionSchedule(config_.solve_period_s);
}

/// Tracks hold what was whitened with the roots, so that these change with the solution only.
void JointTracker::bound_height(const Projector& projector, const FrameView& view) {
  errors_.bound_height(height_above_plane_m(projector, view));
}

JointFrame JointTracker::begin_frame(const LocatedFrame& located) {
  const VehicleState& vehicle = located.view.vehicle;
  if (vehicle.sigma_horizontal_m) errors_.accuracy.report(*vehicle.sigma_horizontal_m);
  const double ground_height_m =
      located.projector.config().ground_height_above_home_m + located.view.lifted_m;
  if (errors_.drift.size() == 0) {
    const double reported_m = reported_height_of_lifted_m(located.projector, located.view);
    errors_.height_prior = seen_from(reported_m, errors_.height_prior);
    errors_.calibration.mean[Index::kHeight] = errors_.height_prior.mean_m;
    bound_height(located.projector, located.view);
  }
  schedule_.count_frame();
  clutter_rate_.count_frame();
  tracks_.clear_evidence();
  DriftTimeline& drift = errors_.drift;
  const NodeSpan span = cover(vehicle);
  if (bound_head(config_.drift, errors_.drift, heights_, tracks_, sleeping_.settled()))
    opening_looks_.close();
  measure_height(located, span);
  return {located.projector,
          located.view,
          span,
          drift.at(span),
          noise_clock_.tick(vehicle.time, located.view.turn.telemetry_gap),
          ground_height_m,
          clutter_rate_.per_frame(),
          stream_start_.observe(located.stamp.captured_at_host, located.stamp.time_sigma_s,
                                config_.sigma_time_s)};
}

void JointTracker::learn_noise(const std::vector<Look>& looks, const Explanation& explanation) {
  errors_.noise.begin_frame();
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const JointAssociation::Match& match = explanation.match_of_look[i];
    if (!match.is_certain() || tracks_[*match.track].track.hits < kHitsToCompare) continue;
    const Pairing& pairing = look_matcher_.pairing_of(match);
    SharedError::Row known_in_part = pairing.jacobian;
    known_in_part.middleCols<2>(SharedError::kFrame).setZero();
    errors_.noise.add({pairing.residual, looks[i].observation.calibration_jacobian.leftCols<3>(),
                       pairing.own_covariance, known_in_part * known_in_part.transpose()});
  }
  errors_.noise.learn_from_frame(fast_position_variance_m2(config_, errors_));
}

/// Where the state has stepped, tracks seen before say less of what comes.
NodeSpan JointTracker::cover(const VehicleState& vehicle) {
  const StateSteps before = std::exchange(steps_, vehicle.steps);
  const double sigma_m = errors_.accuracy.wandering_sigma_m();
  const bool goes_on = vehicle.steps.segment == before.segment || errors_.drift.size() == 0;
  if (goes_on) return errors_.drift.cover(vehicle.time, sigma_m);
  const NodeVector variance = (vehicle.steps.variance - before.variance).cwiseMax(0.0);
  const NodeSpan span = errors_.drift.cover_after_step(vehicle.time, sigma_m, variance);
  errors_.widen_drift(variance);
  for (RestingObject& track : tracks_) refresh(track, errors_, span);
  schedule_.request_for_some_frames();
  return span;
}

void JointTracker::cover_known_points(const LocatedFrame& frame, const FrameShift& shift) {
  const Projector& projector = frame.projector;
  const double margin_px = kCoverMargin * projector.camera().intrinsics().height_px;
  const auto is_covered = [&](const Eigen::Vector3d& point_in_enu) {
    return projector.sees_point(shift.shown(point_in_enu), frame.view, margin_px);
  };
  known_points_.cover(frame.local_frame, frame.ground, frame.view.vehicle.time, detection_rate_.probability(),
                      is_covered);
}

void JointTracker::absorb_matched(const FrameLooks& frame_looks, const Explanation& explanation,
                                  const JointFrame& frame) {
  const std::vector<Look>& looks = frame_looks.at_rest;
  const double found = detection_rate_.probability();
  const double birth = clutter_rate_.birth_probability(config_.birth_probability);
  const FalseOdds false_odds{(1.0 - birth) / birth, clutter_rate_.per_frame() / found};
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const JointAssociation::Match& match = explanation.match_of_look[i];
    if (!match.is_certain()) continue;
    RestingObject& track = tracks_[*match.track];
    Look look = looks[i];
    look.observation =
        look_maker_.linearised_at(track.position_in_enu, look, frame_looks.share_attitude, frame, errors_);
    if (is_far(look, match) && !agrees(look.observation, track, config_.gate, errors_)) {
      track.look.reset();
      track.is_seen = false;
      continue;
    }
    track.existence.hit(found, density(match.innovation, match.innovation_covariance), look.clutter_density);
    record_look(track, look, frame.time(), frame.view.captured_at_host);
    add_to_sums(track, look, errors_);
    opening_looks_.add(track.track.id, looks[i].detection);
    recent_looks_.add(track.track.id, frame.time(), look);
    // Those are not counted as clutter: a dozen of the first seconds would make every new object improbable.
    if (const auto false_look = drop_false_looks(track, look, false_odds, errors_))
      recent_looks_.forget(track.track.id, false_look->observation);
    confirm_if_probable(track, config_.confirm_probability);
    if (track.is_confirmed()) confidence_.count_object(looks[i].detection.confidence);
  }
}

void JointTracker::begin_tentative(const std::vector<Look>& looks, const Explanation& explanation,
                                   const GroundModel& ground, const JointFrame& frame) {
  const double max_range_m = frame.projector.config().max_range_m;
  const double share = ground.is_level() ? config_.sigma_ground_share : 0.0;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (explanation.match_of_look[i].track) continue;
    if (is_full()) {
      ++book_.counters.refused;
      continue;
    }
    RestingObject& track = tracks_.append();
    sleeping_.reserve(tracks_.size() + sleeping_.size());
    begin_object(track, looks[i], clutter_rate_.birth_probability(config_.birth_probability),
                 frame.view.captured_at_host, book_);
    record_look(track, looks[i], frame.time(), frame.view.captured_at_host);
    const Point place = ground_point(looks[i], ground, max_range_m);
    track.ground = ground_prior(ground, place.head<2>(), share * looks[i].camera_height_m);
    track.prior = track.ground;
    begin_sums(track, looks[i], errors_);
    opening_looks_.add(track.track.id, looks[i].detection);
    recent_looks_.add(track.track.id, frame.time(), looks[i]);
    track.look = i;
  }
}

void JointTracker::remove_improbable() {
  for (std::size_t k = tracks_.size(); k-- > 0;) {
    Track& track = tracks_[k].track;
    track.existence = tracks_[k].existence.probability();
    retract_if_improbable(tracks_[k]);
    if (*track.existence >= config_.delete_probability) continue;
    if (!tracks_[k].was_confirmed) {
      clutter_rate_.count_false(track.hits);
      confidence_.count_false(tracks_[k].confidences);
    }
    remove(k);
  }
}

void JointTracker::remove(std::size_t row) {
  known_points_.forget(tracks_[row].track.id);
  published_.remove(tracks_[row].track.id);
  leave_settled(tracks_[row], sleeping_.settled());
  tracks_.remove(row);
  ++book_.counters.removed;
}

void JointTracker::refine(const LocatedFrame& located, const JointFrame& frame, const FrameNoise& noise) {
  schedule_.begin_solution(frame.time());
  const auto solution = solve(located, frame);
  if (!solution) return;
  if (is_false_start(located)) return start_over();
  learn_wandering(*solution);
  merge_compatible(*solution, frame, noise);
  const std::size_t budget = known_points_.is_empty() ? kCovariancesPerSolution : tracks_.size();
  const std::size_t left = update_covariances(*solution, frame.time(), budget, tracks_);
  let_sleep(located, *solution, left);
  if (!surveyed_.match(*solution, errors_.accuracy, config_.gate, config_.ambiguity, known_points_, tracks_))
    return;
  if (const auto with_known_points = solve(located, frame))
    update_covariances(*with_known_points, frame.time(), budget, tracks_);
}

std::optional<ArrowheadSolver::Solution> JointTracker::solve(const LocatedFrame& located,
                                                             const JointFrame& frame) {
  follow_ground(located.ground, tracks_);
  if (opening_looks_.is_open())
    opening_looks_.linearise_anew(located.viewer, frame.projector, look_maker_, errors_, tracks_,
                                  recent_looks_);
  errors_.believe_in_sway(fast_position_variance_m2(config_, errors_), frame.repetition.lasts());
  const auto solution =
      solver_.solve(tracks_.landmarks(), errors_.prior(), errors_.drift, heights_, &sleeping_.settled());
  if (solution) {
    errors_.take(*solution);
    bound_height(frame.projector, frame.view);
  }
  for (RestingObject& track : tracks_) refresh(track, errors_, frame.span);
  return solution;
}

void JointTracker::learn_wandering(const Solution& solution) {
  if (!schedule_.teaches_wandering()) return;
  const auto wandering = solution.observed_wandering(errors_.drift);
  if (wandering) errors_.drift.set_position_scale(errors_.accuracy.believed_scale(*wandering));
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
  merge_sums(kept, gone, errors_.drift);
  kept.is_known = kept.is_known || gone.is_known;
  merge_into(kept, gone);
  known_points_.rename(gone.track.id, kept.track.id);
  opening_looks_.rename(gone.track.id, kept.track.id);
  recent_looks_.rename(gone.track.id, kept.track.id);
  for (RestingObject& track : tracks_) track.neighbours.rename(gone.track.id, kept.track.id);
  published_.remove(gone.track.id);
  tracks_.remove(gone_row);
  ++book_.counters.merged;
}

bool JointTracker::is_full() const {
  return tracks_.is_full() ||
         tracks_.size() + sleeping_.size() >= static_cast<std::size_t>(config_.max_tracks);
}

void JointTracker::wake_near(const LocatedFrame& located, const JointFrame& frame) {
  const double sigma_time_s = clock_watch_.is_in_doubt() ? config_.prior.sigma_latency_s : 0.0;
  const auto wake = [&](const JointFrame& seen) {
    const auto area = area_in_view(seen, errors_, config_.sigma_ground_m, sigma_time_s);
    geoloc::wake_near(area, seen, errors_, published_, sleeping_, tracks_);
  };
  wake(frame);
  if (located.turned != nullptr) wake(frame.seen_from(located.turned->view));
}

/// Some of those that sleep are brought up to date with each solution, covariances and all. Surveys and the
/// first looks may still tell of any object.
void JointTracker::let_sleep(const LocatedFrame& located, const Solution& solution, std::size_t covariances) {
  if (opening_looks_.is_open() || !known_points_.is_empty()) return;
  const VehicleTime now = located.view.vehicle.time;
  const double level_m = level_above_home_m(located.projector);
  for (std::size_t row = tracks_.size(); row-- > 0;) {
    RestingObject& object = tracks_[row];
    if (may_sleep(object, tracks_, now, proven_at_, config_.merge_radius_m)) {
      published_.set(published_track(object, level_m), object.published_at);
      sleeping_.put(object, errors_.drift);
      tracks_.remove(row);
    } else if (may_be_forgotten(object, tracks_, now)) {
      remove(row);
    }
  }
  sleeping_.visit_some(
      covariances, errors_,
      [&](std::uint64_t id, std::size_t& place, const Point& /*position*/, const Landmark& landmark) {
        const PointMatrix covariance = solution.covariance(landmark);
        Track& track = *published_.find(id, place);
        track.position_in_enu.covariance = covariance.topLeftCorner<2, 2>();
        track.height->sigma_m = std::sqrt(covariance(2, 2));
      });
}

double JointTracker::level_above_home_m(const Projector& projector) const {
  return projector.config().ground_height_above_home_m - errors_.calibration.height_m();
}

/// Those that sleep follow, `sleeping` of them at a time.
void JointTracker::publish(const Projector& projector, std::size_t sleeping) {
  const double level_m = level_above_home_m(projector);
  for (RestingObject& object : tracks_) published_.set(published_track(object, level_m), object.published_at);
  sleeping_.visit_some(sleeping, errors_,
                       [&](std::uint64_t id, std::size_t& place, const Point& position, const Landmark&) {
                         Track& track = *published_.find(id, place);
                         track.position_in_enu.mean = position.head<2>();
                         track.height->above_home_m = position.z() + level_m;
                       });
  if (!config_.moving.classes.empty()) add_moving();
}

void JointTracker::add_moving() {
  published_with_moving_.clear();
  const auto& moving = moving_.objects();
  auto next_moving = moving.begin();
  for (const Track& track : published_.all()) {
    for (; next_moving != moving.end() && next_moving->track.id < track.id; ++next_moving)
      published_with_moving_.push_back(next_moving->track);
    published_with_moving_.push_back(track);
  }
  for (; next_moving != moving.end(); ++next_moving) published_with_moving_.push_back(next_moving->track);
}

}  // namespace geoloc
