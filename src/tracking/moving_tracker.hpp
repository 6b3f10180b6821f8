// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "geoloc/tracking/assignment.hpp"
#include "geoloc/tracking/joint_tracker_config.hpp"
#include "tracking/constant_velocity.hpp"
#include "tracking/joint_frame.hpp"
#include "tracking/look.hpp"
#include "tracking/tracked_object.hpp"

namespace geoloc {

/// An object that may move.
struct MovingObject : TrackedObject {
  ConstantVelocity motion;  ///< at the present frame
  /// d position / d shared error of the next looks, whitened [m].
  SharedError::Row sensitivity = SharedError::Row::Zero();
  double height_m = 0.0;  ///< of the ground where it was seen last, above the level ground
  bool is_lost = false;   ///< it could be anywhere: no look is its any more
};

/// Objects of the classes that may move: a Kalman filter with constant velocity each. They use what is known
/// of calibration and drift and teach nothing of it, so that they cannot corrupt it. A track's position is
/// that of the last look; a confirmed object that is not seen again stays where it was seen, and is not
/// recognized later.
class MovingTracker {
 public:
  /// What is known of a frame besides its looks.
  struct Context {
    const JointFrame& frame;
    const FrameShift& shift;
    Eigen::Matrix2d offset_covariance;  ///< of the vehicle's constant position error [m^2]
    double detection_probability;       ///< of an object in full view
  };

  /// `config` is checked, and must outlive the tracker. max_detections: the most that update() will be given.
  MovingTracker(const JointTrackerConfig& config, int max_detections);
  /// geometry/room.hpp
  static std::size_t take_room(MovingTracker* self, const JointTrackerConfig& config, int max_detections);

  /// One frame's looks at objects of moving classes.
  void update(const std::vector<Look>& looks, const Context& context, TrackBook& book);

  /// In order of their ids.
  const std::vector<MovingObject>& objects() const { return objects_; }

 private:
  void predict(VehicleTime now);
  void associate(const std::vector<Look>& looks);
  void absorb(MovingObject& object, const Look& look, const Context& context) const;
  void begin(const Look& look, const Context& context, TrackBook& book);
  void weigh_missed(const Context& context);
  void note_same_frame_evidence();
  void remove_improbable(TrackCounters& counters);
  void merge_duplicates(TrackCounters& counters);
  bool are_one(const MovingObject& a, const MovingObject& b) const;
  void merge(std::size_t kept, std::size_t gone);
  void remove(std::size_t row);

  const JointTrackerConfig& config_;
  std::vector<MovingObject> objects_;
  VehicleTime predicted_to_{};
  std::vector<std::size_t> active_;  // rows that a look may show
  std::vector<std::optional<std::size_t>> row_of_look_;
  Eigen::MatrixXd costs_;  // looks x active
  AssignmentSolver assignment_;
};

}  // namespace geoloc
