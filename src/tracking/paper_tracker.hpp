// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geoloc/camera/detection.hpp"
#include "geoloc/projection/ground_fix.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/tracking/assignment.hpp"
#include "geoloc/tracking/paper_tracker_config.hpp"
#include "geoloc/tracking/track.hpp"
#include "tracking/tracker.hpp"

namespace geoloc {

/// Spatial refinement as published (paper, section 4): optimal assignment on Mahalanobis distances, one
/// Kalman filter per object, penalties for objects that should be visible and are not, merging of confirmed
/// neighbours. Where a detection states a sigma, what that makes on the ground is added to R.
class PaperTracker final : public Tracker {
 public:
  /// Throws std::invalid_argument naming every problem. `max_detections`: the most that update() will be
  /// given.
  PaperTracker(const PaperTrackerConfig& config, int max_detections);
  /// geometry/room.hpp
  static std::size_t take_room(PaperTracker* self, const PaperTrackerConfig& config, int max_detections);

  void update(const LocatedFrame& frame) override;

  const std::vector<Track>& tracks() const override { return tracks_; }
  const TrackCounters& counters() const override { return counters_; }
  const Calibration& calibration() const override { return no_calibration_; }
  double lift_m(double) const override { return 0.0; }
  std::optional<Calibration> calibration_of_camera() const override { return std::nullopt; }
  const std::vector<KnownPointMatch>& known_points() const override { return no_known_points_; }

 private:
  void associate(const std::vector<LocatedDetection>& detections);
  Eigen::Matrix2d measurement_covariance(const LocatedDetection& located) const;
  void update_matched(const std::vector<LocatedDetection>& detections, HostTime captured_at);
  void penalise_missed(const LocatedFrame& frame);
  void remove_unreliable();
  void start_tentative(const std::vector<LocatedDetection>& detections, HostTime captured_at);
  void merge_near_confirmed();

  PaperTrackerConfig config_;
  Eigen::Matrix2d measurement_covariance_;
  Eigen::Matrix2d process_covariance_;
  std::vector<Track> tracks_;
  AssignmentSolver solver_;
  Eigen::MatrixXd costs_;                // detections x candidate tracks
  std::vector<std::size_t> candidates_;  // tracks within the gate of some detection
  std::vector<std::optional<std::size_t>> track_of_detection_;
  std::vector<char> track_is_matched_;
  std::uint64_t next_id_ = 1;
  TrackCounters counters_;
  const Calibration no_calibration_;
  const std::vector<KnownPointMatch> no_known_points_;
};

}  // namespace geoloc
