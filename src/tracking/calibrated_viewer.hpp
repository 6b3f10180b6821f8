// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "calibration/shared_error_estimate.hpp"
#include "geoloc/projection/ground_fix.hpp"
#include "geoloc/projection/projector.hpp"
#include "projection/frame_viewer.hpp"

namespace geoloc {

/// From where frames are seen, at any latency, with what is known of the camera by now.
struct CalibratedViewer {
  const FrameViewer& viewer;
  const Projector& projector;
  const SharedErrorEstimate& errors;
  bool calibration_is_void;  ///< learnt with the latency that is in question
  double terrain_m;          ///< of the ground under the present frame's camera

  /// Limits in pixels are those of images of the usual width, 1280 px; of this camera's they are so much
  /// wider.
  double image_scale() const;

  std::optional<FrameView> at(FrameStamp stamp, double latency_s) const;
};

}  // namespace geoloc
