// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "geoloc/calibration/arrowhead.hpp"
#include "geoloc/calibration/linearize.hpp"
#include "geoloc/projection/frame_view.hpp"
#include "geoloc/tracking/existence.hpp"
#include "geoloc/tracking/joint_association.hpp"
#include "geoloc/tracking/joint_tracker_config.hpp"
#include "geoloc/tracking/known_points.hpp"
#include "geoloc/tracking/look.hpp"
#include "geoloc/tracking/moving_tracker.hpp"
#include "geoloc/tracking/neighbours.hpp"
#include "geoloc/tracking/track.hpp"

namespace geoloc {

/// Objects and calibration together (docs/method.md): every look at an object is information on the object,
/// on the camera's calibration and on the drift of the vehicle's state.
class JointTracker {
 public:
  /// Throws std::invalid_argument naming every problem. `max_detections`: the most that update() will be
  /// given.
  JointTracker(const JointTrackerConfig& config, std::vector<KnownPoint> known_points, int max_detections);

  /// The frame of all positions, before the first update().
  void set_local_frame(const LocalFrame& frame) { known_points_.place(frame); }

  /// One frame: its detections in a canonical order, located with calibration() applied to the view.
  void update(const std::vector<LocatedDetection>& detections, const Projector& projector,
              const FrameView& view);

  /// Tentative and confirmed, in order of their ids.
  const std::vector<Track>& tracks() const { return config_.moving.classes.empty() ? tracks_ : all_tracks_; }
  const TrackCounters& counters() const { return book_.counters; }

  const KnownPoints& known_points() const { return known_points_; }

  /// What looks are located with: the camera's constant errors and those of the autopilot's state in one.
  const Calibration& calibration() const { return calibration_; }

  /// The same as an estimate of the camera's errors alone: the autopilot's own are part of its sigma.
  Calibration calibration_of_camera() const;

 private:
  /// Looks that make a track worth comparing with others and with known points.
  static constexpr int kHitsToCompare = 3;

  /// Of looks at a track that came while another, younger one beside it was seen too: drawn to one side, they
  /// tell that the track was made of looks at both.
  struct Mixture {
    int looks = 0;
    Eigen::Vector2d sum_of_innovations = Eigen::Vector2d::Zero();
    double sum_of_noise = 0.0;  // traces
  };

  /// What the tracker knows of a track beyond its public face; same index as in tracks_.
  struct Estimate {
    std::size_t landmark = 0;  // place in landmarks_
    Existence existence{0.5};
    Neighbours neighbours;
    Mixture mixture;
    VehicleTime last_look{};
    bool is_compared = false;                                     // with others, since it can be
    bool is_known = false;                                        // its surveyed place is in the sums
    Eigen::Matrix2d pixel_information = Eigen::Matrix2d::Zero();  // sum of the looks'
    double size_m = 0.0;                                          // apparent, mean
    Eigen::Matrix2d own_covariance = Eigen::Matrix2d::Zero();     // A^-1
    SharedError::Row gain =
        SharedError::Row::Zero();  // of the position, by what the next looks share, whitened
  };

  /// How far a track can be from a look that shows it: a bound that is cheap for every pair of them.
  struct Reach {
    Eigen::Vector2d position;
    double own_variance = 0.0;  // trace
    double shared_m = 0.0;      // distance of its Jacobian from the looks' mean one
  };

  void begin_frame(const FrameView& view);
  void make_looks(const std::vector<LocatedDetection>& detections, const Projector& projector,
                  const FrameView& view);
  Look make_look(const LocatedDetection& located, double looks_that_share, const Projector& projector,
                 const FrameView& view) const;
  void track_moving(const Projector& projector, const FrameView& view);
  void list_all_tracks();
  void associate();
  void add_pairings();
  Pairing pairing(std::size_t look, std::size_t track) const;
  SharedError::Row whitened(const SharedError::CalibrationRow& by_calibration,
                            const Eigen::Matrix<double, 2, kNodeSize>& by_drift) const;
  void find_roots();
  void prefer_older_twins();
  const Pairing* oldest_twin(std::size_t look) const;
  bool is_older(int track, int other) const;
  bool is_matched(std::size_t look) const;
  std::optional<std::size_t> seen_as(std::size_t track) const;
  bool is_seen(std::size_t track) const { return look_of_track_[track] != JointAssociation::kNone; }
  Eigen::Vector2d common_shift();
  void absorb_matched(HostTime captured_at);
  void note_same_frame_evidence();
  void split_if_mixed(std::size_t track, std::size_t younger);
  bool is_drawn_aside(std::size_t track, std::size_t younger) const;
  double counted_detection_probability() const;
  void weigh_missed(const Projector& projector, const FrameView& view);
  void count_opportunity(bool was_seen);
  void start_tentative(HostTime captured_at);
  void remove_improbable();
  void solve_if_due(VehicleTime now);
  bool solve();
  void state_covariances();
  void merge_compatible();
  bool are_not_told_apart(std::size_t a, std::size_t b) const;
  bool may_be_one(std::size_t a, std::size_t b) const;
  void compare_soon(std::size_t track);
  Eigen::Matrix2d covariance_of_difference(std::size_t a, std::size_t b) const;
  double noise_share(const Track& track) const;
  double shared_share_of_noise(Duration pause) const;
  void merge(std::size_t a, std::size_t b);
  void absorb(std::size_t track, const Look& look, HostTime captured_at);
  void add_to_sums(std::size_t track, const Look& look);
  Eigen::Matrix2d covariance_of_first(const Look& look) const;
  void refresh(std::size_t track);
  Eigen::Matrix<double, 2, kNodeSize> recent_drift(const Landmark& landmark) const;
  void remove(std::size_t track);
  double detection_probability(std::size_t track, const Projector& projector, const FrameView& view) const;
  void learn_wandering();
  void cover_known_points(const Projector& projector, const FrameView& view);
  bool match_known_points();
  Eigen::Vector2d shown_in_frame(const Eigen::Vector2d& position_in_enu) const;
  double reported_sigma_m() const;
  double sigma_offset_m() const;

  JointTrackerConfig config_;
  DriftTimeline drift_;
  ArrowheadSolver solver_;
  Calibration calibration_;
  /// Roots of the covariances, C = R R', of calibration and newest node: what whitens Jacobians.
  SharedError::CalibrationMatrix calibration_root_;
  NodeMatrix drift_root_;
  KnownPoints known_points_;
  std::vector<KnownPoints::Candidate> known_candidates_;  // scratch

  MovingTracker moving_;
  std::vector<Track> all_tracks_;  // where there are moving ones, those too

  std::vector<Track> tracks_;
  std::vector<Estimate> estimates_;
  std::vector<Landmark> landmarks_;  // places are reused
  std::vector<std::size_t> free_landmarks_;
  std::vector<const Landmark*> all_landmarks_;  // scratch of solve

  // The present frame.
  VehicleTime now_{};
  std::vector<Look> looks_;
  std::vector<Look> moving_looks_;
  NodeVector drift_now_ = NodeVector::Zero();
  NodeSpan span_{};
  double noise_correlation_ = 1.0;     // frames that share their noise
  double attitude_correlation_ = 1.0;  // that of the attitude, in the sums
  double reported_accuracy_m_;
  Eigen::Matrix2d frame_noise_ = Eigen::Matrix2d::Zero();  // of attitude and position, shared by the looks
  Eigen::Vector2d shift_ = Eigen::Vector2d::Zero();
  JointAssociation association_;
  std::vector<JointAssociation::Match> matches_;        // of the looks
  std::vector<int> look_of_track_;                      // kNone: not seen in this frame
  std::vector<char> is_in_doubt_;                       // perhaps seen: no conclusion
  std::vector<double> detection_probability_of_track_;  // of the tracks this frame should show
  std::vector<double> median_scratch_;
  std::vector<Reach> reach_of_track_;  // scratch of add_pairings

  std::optional<VehicleTime> solved_at_;
  bool is_comparison_due_ = false;  // of two tracks that may be one
  int frames_ = 0;
  int solutions_ = 0;
  double expected_hits_;  // of confirmed objects in view, and how many there were: the detection probability
  double opportunities_;
  TrackBook book_;
};

}  // namespace geoloc
