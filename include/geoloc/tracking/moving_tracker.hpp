// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "geoloc/projection/frame_view.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/tracking/assignment.hpp"
#include "geoloc/tracking/constant_velocity.hpp"
#include "geoloc/tracking/existence.hpp"
#include "geoloc/tracking/joint_tracker_config.hpp"
#include "geoloc/tracking/look.hpp"
#include "geoloc/tracking/neighbours.hpp"
#include "geoloc/tracking/track.hpp"

namespace geoloc {

/// Ids and counts that the trackers of one flight share.
struct TrackBook {
  std::uint64_t next_id = 1;
  TrackCounters counters;
};

/// Objects of the classes that may move: a Kalman filter with constant velocity each. They use what is known
/// of calibration and drift and teach nothing of it, so that they cannot corrupt it. A track's position is
/// that of the last look; a confirmed object that is not seen again stays where it was seen, and is not
/// recognized later.
class MovingTracker {
 public:
  /// What a frame says besides its looks.
  struct Frame {
    const Projector& projector;
    const FrameView& view;
    Eigen::Vector2d correction;         ///< the frame shows a place at itself minus this [m]
    Eigen::Matrix2d offset_covariance;  ///< of the vehicle's constant position error [m^2]
    double detection_probability;       ///< of an object in full view
  };

  /// Throws nothing; the configuration is checked. max_detections: the most that update() will be given.
  MovingTracker(const JointTrackerConfig& config, int max_detections);

  bool is_of_moving_class(const Detection& detection) const;

  /// One frame's looks at objects of moving classes.
  void update(const std::vector<Look>& looks, const Frame& frame, TrackBook& book);

  /// In order of their ids.
  const std::vector<Track>& tracks() const { return tracks_; }

 private:
  /// What is known of a track beyond its public face; same index as in tracks_.
  struct Estimate {
    ConstantVelocity motion;  // at the last frame
    VehicleTime last_look{};
    SharedError::Row gain = SharedError::Row::Zero();  // of the position, whitened
    Existence existence{0.5};
    Neighbours neighbours;
    double size_m = 0.0;
    bool is_lost = false;
  };

  void predict(VehicleTime now);
  void associate(const std::vector<Look>& looks);
  void absorb(std::size_t track, const Look& look, const Frame& frame);
  void start(const Look& look, const Frame& frame, TrackBook& book);
  void weigh_missed(const Frame& frame);
  void note_same_frame_evidence();
  void remove_improbable(TrackCounters& counters);
  void merge_duplicates(TrackCounters& counters);
  bool are_one(std::size_t a, std::size_t b) const;
  void remove(std::size_t track);

  JointTrackerConfig config_;
  std::vector<Track> tracks_;
  std::vector<Estimate> estimates_;
  VehicleTime predicted_to_{};
  std::vector<std::size_t> active_;  // tracks that a look may show
  std::vector<int> track_of_look_;
  std::vector<char> is_seen_;  // of the tracks
  Eigen::MatrixXd costs_;      // looks x active
  AssignmentSolver assignment_;
};

}  // namespace geoloc
