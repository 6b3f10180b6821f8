// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/calibration/calibration.hpp"
#include "geoloc/camera/camera.hpp"
#include "geoloc/geometry/expected.hpp"
#include "geoloc/projection/ground_fix.hpp"
#include "geoloc/state/state_provider.hpp"

namespace geoloc {

/// From where frames were seen, by their stamps and a latency. Refers to what it is made of.
struct FrameViewer {
  const StateProvider& state;
  const CameraMount& mount;
  CameraOrientation orientation;

  /// The nominal pose, neither turned nor lifted. NoState: why there is none.
  Expected<FrameView, NoState> nominal_view(FrameStamp stamp, double latency_s) const;
};

/// The view turned by the boresight, and lifted by `lift_m` above the ground below the vehicle (terrain_m).
FrameView calibrated(FrameView nominal_view, const Calibration& calibration, double lift_m);

}  // namespace geoloc
