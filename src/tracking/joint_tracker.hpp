// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calibration/arrowhead.hpp"
#include "calibration/shared_error_estimate.hpp"
#include "geoloc/tracking/joint_tracker_config.hpp"
#include "tracking/clock_watch.hpp"
#include "tracking/clutter_rate.hpp"
#include "tracking/confidence_evidence.hpp"
#include "tracking/detection_rate.hpp"
#include "tracking/joint_frame.hpp"
#include "tracking/known_point_matcher.hpp"
#include "tracking/latency_change.hpp"
#include "tracking/latency_watch.hpp"
#include "tracking/look_maker.hpp"
#include "tracking/look_matcher.hpp"
#include "tracking/moving_tracker.hpp"
#include "tracking/opening_looks.hpp"
#include "tracking/published_tracks.hpp"
#include "tracking/recent_looks.hpp"
#include "tracking/sleeping_objects.hpp"
#include "tracking/solution_schedule.hpp"
#include "tracking/surveyed_objects.hpp"
#include "tracking/track_table.hpp"
#include "tracking/tracker.hpp"
#include "tracking/turned_yaw.hpp"
#include "tracking/waiting_frames.hpp"

namespace geoloc {

/// Objects, calibration and drift estimated jointly (docs/method.md): every look at an object is information
/// on the object, on the camera's calibration and on the drift of the vehicle's state.
class JointTracker final : public Tracker {
 public:
  /// Throws std::invalid_argument naming every problem. `max_detections`: the most that update() will be
  /// given.
  JointTracker(const JointTrackerConfig& config, std::vector<KnownPoint> known_points, int max_detections);
  /// geometry/room.hpp
  static std::size_t take_room(JointTracker* self, const JointTrackerConfig& config,
                               const std::vector<KnownPoint>& known_points, int max_detections);

  void update(const LocatedFrame& frame) override;
  void finish(const LocatedFrame& last) override;

  const std::vector<Track>& tracks() const override {
    return config_.moving.classes.empty() ? published_.all() : published_with_moving_;
  }
  const TrackCounters& counters() const override { return book_.counters; }
  const Calibration& calibration() const override { return errors_.calibration; }
  double lift_m(double reported_height_above_ground_m) const override {
    return errors_.lift_m(reported_height_above_ground_m);
  }
  std::optional<Calibration> calibration_of_camera() const override;
  std::optional<JointEstimate> estimate(double ground_height_above_home_m) const override;
  const std::vector<KnownPointMatch>& known_points() const override { return known_points_.matches(); }

 private:
  using Solution = ArrowheadSolver::Solution;

  void process(const LocatedFrame& located);
  void process_in_turn(const LocatedFrame& located);
  void process_next(const LocatedFrame& newest);
  bool is_clock_watched() const;
  CalibratedViewer viewer_of(const LocatedFrame& located) const;
  ChangeOfLatency change_to(const LatencyPrior& latency, const LocatedFrame& located);
  WatchExpectation expected_of(const LocatedFrame& located) const;
  void watch_clock(const LocatedFrame& located);
  void measure_height(const LocatedFrame& located, const NodeSpan& now);
  void bound_height(const Projector& projector, const FrameView& view);
  JointFrame begin_frame(const LocatedFrame& frame);
  void learn_noise(const std::vector<Look>& looks, const Explanation& explanation);
  void learn(const LocatedFrame& located, const JointFrame& frame);
  void weigh_confidence(FrameLooks& looks) const;
  bool is_turned(const LocatedFrame& located, const JointFrame& frame);
  FrameFit fit(const LocatedFrame& located, const JointFrame& frame);
  FrameShift shift_of(const JointFrame& frame, const Explanation& explanation) const;
  FrameNoise noise_of(const FrameLooks& looks, const JointFrame& frame) const;
  NodeSpan cover(const VehicleState& vehicle);
  void cover_known_points(const LocatedFrame& frame, const FrameShift& shift);
  void absorb_matched(const FrameLooks& looks, const Explanation& explanation, const JointFrame& frame);
  void begin_tentative(const std::vector<Look>& looks, const Explanation& explanation,
                       const GroundModel& ground, const JointFrame& frame);
  void remove_improbable();
  void remove(std::size_t row);
  void watch_start(const LocatedFrame& located);
  std::optional<LatencyPrior> latency_by_turning(const LocatedFrame& located, bool is_start);
  void begin_anew(const LatencyPrior& latency);
  bool is_false_start(const LocatedFrame& located) const;
  void start_over();
  void forget_flight();
  VehicleTime end_of_latency(std::size_t first_changed, const LocatedFrame& newest) const;
  void go_on_with_latency(const LatencyPrior& latency, const ChangeOfLatency& change,
                          const LocatedFrame& frame);
  void refine(const LocatedFrame& located, const JointFrame& frame, const FrameNoise& noise);
  std::optional<Solution> solve(const LocatedFrame& located, const JointFrame& frame);
  void learn_wandering(const Solution& solution);
  void merge_compatible(const Solution& solution, const JointFrame& frame, const FrameNoise& noise);
  void merge(std::size_t kept, std::size_t gone);
  bool is_full() const;
  void wake_near(const LocatedFrame& located, const JointFrame& frame);
  void let_sleep(const LocatedFrame& located, const Solution& solution, std::size_t covariances);
  double level_above_home_m(const Projector& projector) const;
  void publish(const Projector& projector, std::size_t sleeping);
  void add_moving();

  const JointTrackerConfig config_;
  ArrowheadSolver solver_;
  SharedErrorEstimate errors_;
  HeightLog heights_;
  StateSteps steps_;  // of the vehicle's state, up to the last frame
  NoiseClock noise_clock_;
  StreamStart stream_start_;
  LatencyWatch latency_watch_;
  ClockWatch clock_watch_;
  WaitingFrames waiting_;
  VehicleTime proven_at_{};  // the last frame by which the latency was as believed
  SolutionSchedule schedule_;
  LookMaker look_maker_;
  LookMatcher look_matcher_;
  DetectionRate detection_rate_;
  ClutterRate clutter_rate_;
  ConfidenceEvidence confidence_;
  KnownPointMatcher known_points_;
  SurveyedObjects surveyed_;
  TrackTable tracks_;
  OpeningLooks opening_looks_;
  int false_starts_ = 0;
  RecentLooks recent_looks_;
  MovingTracker moving_;
  TrackBook book_;
  SleepingObjects sleeping_;
  PublishedTracks published_;                 // of the objects at rest
  std::vector<Track> published_with_moving_;  // where there are moving classes
};

}  // namespace geoloc
