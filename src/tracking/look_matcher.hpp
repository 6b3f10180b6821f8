// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "geoloc/tracking/joint_tracker_config.hpp"
#include "tracking/joint_association.hpp"
#include "tracking/joint_frame.hpp"
#include "tracking/look.hpp"
#include "tracking/track_table.hpp"

namespace geoloc {

/// How a frame's looks are explained.
struct Explanation {
  std::vector<JointAssociation::Match> match_of_look;
  Eigen::Vector2d common_shift = Eigen::Vector2d::Zero();  ///< median of looks minus their tracks [m]
  double cost = 0.0;                                       ///< by try_to_explain(): JointAssociation::cost()
};

/// Which look shows which object at rest.
class LookMatcher {
 public:
  /// `config` must outlive it.
  LookMatcher(const JointTrackerConfig& config, int max_detections);
  /// geometry/room.hpp
  static std::size_t take_room(LookMatcher* self, const JointTrackerConfig& config, int max_detections);

  /// Explains the looks and notes in the tracks what they are evidence of. The reference holds until the next
  /// call.
  const Explanation& explain(const std::vector<Look>& looks, const FrameNoise& noise, TrackTable& tracks);

  /// The same without noting anything, with its cost.
  const Explanation& try_to_explain(const std::vector<Look>& looks, const FrameNoise& noise,
                                    const TrackTable& tracks);

  /// The pair that a look of the last frame was explained by.
  const Pairing& pairing_of(const JointAssociation::Match& match) const {
    return association_.pairings()[match.pairing];
  }

 private:
  using HeightRow = Eigen::Matrix<double, 1, SharedError::kSize>;

  /// How far a track can be from a look that shows it: a bound that is cheap for every pair of them.
  struct Reach {
    Eigen::Vector2d shown;  // where the frame shows it
    double own_variance;    // trace
    double shared_m;        // distance of its Jacobian from the looks' mean one
  };

  void find_explanation(const std::vector<Look>& looks, const FrameNoise& noise, const TrackTable& tracks);
  void associate(const std::vector<Look>& looks, const FrameNoise& noise, double shake,
                 const TrackTable& tracks);
  void consider_shake(const std::vector<Look>& looks, const FrameNoise& noise, const TrackTable& tracks);
  int looks_alone() const;
  void add_pairings(const std::vector<Look>& looks, const FrameNoise& noise, double shake,
                    const TrackTable& tracks);
  Reach list_reaches(const Look& any_look, const TrackTable& tracks, const SharedError::Row& mean_of_looks,
                     const HeightRow& mean_of_heights);
  Pairing pairing(const Look& look, const RestingObject& track, const FrameNoise& noise, double shake) const;
  void prefer_older_twins(const TrackTable& tracks);
  const Pairing* oldest_twin(std::size_t look, const TrackTable& tracks) const;
  Eigen::Vector2d common_shift(const std::vector<Look>& looks, const TrackTable& tracks);
  void note_evidence(TrackTable& tracks) const;

  const JointTrackerConfig& config_;
  JointAssociation association_;
  Explanation explanation_;
  std::vector<Reach> reach_of_track_;  // scratch of add_pairings
  std::vector<double> median_scratch_;
};

}  // namespace geoloc
