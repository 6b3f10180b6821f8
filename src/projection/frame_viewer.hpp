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
  const CameraMount& mount;  ///< of frames whose stamp has none
  CameraOrientation orientation;

  const CameraMount& mount_of(const FrameStamp& stamp) const { return stamp.mount ? *stamp.mount : mount; }

  /// Whether everything that tells how the camera was at that time has samples from beyond it.
  bool is_settled(const FrameStamp& stamp, VehicleTime time) const;

  /// The nominal pose, neither turned nor lifted. NoState: why there is none.
  Expected<FrameView, NoState> nominal_view(const FrameStamp& stamp, double latency_s) const;
};

/// How high the camera of a nominal view is reported to be above the ground below the vehicle [m].
inline double reported_height_m(const FrameView& nominal_view, const ProjectorConfig& projector) {
  return nominal_view.enu_from_camera.translation.z() - projector.ground_height_above_home_m -
         nominal_view.terrain_m;
}

/// The view turned by the boresight, with the calibration's focal length, and lifted by `lift_m` above the
/// ground below the vehicle (terrain_m).
FrameView calibrated(FrameView nominal_view, const Calibration& calibration, double lift_m);

}  // namespace geoloc
