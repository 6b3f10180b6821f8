// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

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

  /// Duplicates are left out. The reference holds until the next call.
  FrameLooks& make(const std::vector<LocatedDetection>& detections, const JointFrame& frame,
                   const SharedErrorEstimate& errors);

  /// One of them, which shares the attitude's noise with so many; all but the Jacobian by the frame's noise.
  Look make_look(const LocatedDetection& located, double looks_that_share, const JointFrame& frame,
                 const SharedErrorEstimate& errors) const;

 private:
  const JointTrackerConfig& config_;
  FrameLooks looks_;
};

}  // namespace geoloc
