// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/linearize.hpp"
#include "calibration/shared_error_estimate.hpp"
#include "geoloc/tracking/joint_tracker_config.hpp"
#include "tracking/joint_frame.hpp"
#include "tracking/look.hpp"

namespace geoloc {

/// Variance of the position from second to second, per axis, as the reported accuracy lets expect [m^2].
double fast_position_variance_m2(const JointTrackerConfig& config, const SharedErrorEstimate& errors);

bool is_of_moving_class(const Detection& detection, const MovingConfig& moving);

/// What a frame's detections say, as looks.
class LookMaker {
 public:
  /// `config` must outlive it. max_detections: the most that make() will be given.
  LookMaker(const JointTrackerConfig& config, int max_detections);
  /// geometry/room.hpp
  static std::size_t take_room(LookMaker* self, const JointTrackerConfig& config, int max_detections);

  /// Duplicates are left out. The reference holds until the next call.
  FrameLooks& make(const std::vector<LocatedDetection>& detections, const JointFrame& frame,
                   const SharedErrorEstimate& errors);

  /// One of them, which shares the attitude's noise with so many; all but the Jacobian by the frame's noise.
  Look make_look(const LocatedDetection& located, double looks_that_share, const JointFrame& frame,
                 const SharedErrorEstimate& errors) const;

  /// The look, linearised where the object should be seen. Jacobians at the place where it was seen would
  /// hold the look's own noise, which draws the estimate towards zero (errors in variables): in weakly
  /// observed directions, such as the scale of the map, by more than the noise itself. As it is where the
  /// object should not be in view.
  LandmarkObservation linearised_at(const Point& position_in_enu, const Look& look, double looks_that_share,
                                    const JointFrame& frame, const SharedErrorEstimate& errors) const;

 private:
  struct Noise;
  Noise noise_of(const Detection& detection, const GroundFix& fix, const FixJacobians& jacobians,
                 const JointFrame& frame, const SharedErrorEstimate& errors) const;
  static LandmarkObservation observation(const GroundFix& fix, const FixJacobians& jacobians,
                                         const Noise& noise, double looks_that_share, const JointFrame& frame,
                                         const SharedErrorEstimate& errors);

  const JointTrackerConfig& config_;
  FrameLooks looks_;
};

}  // namespace geoloc
