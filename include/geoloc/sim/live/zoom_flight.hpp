// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/sim/flight/flight.hpp"

namespace geoloc::sim {

/// How an operator zooms: the camera stays at the least for 4 to 8 s, runs to somewhere up to the most, looks
/// for 2 to 4 s, and runs back.
struct ZoomSettings {
  double least = 1.0;  ///< 1 is the calibration
  double most = 4.0;

  /// Every fault.
  std::vector<std::string> problems() const;
};

/// The same flight with a camera that zooms, by a factor of 2 in 0.7 s at the most. It is a component of its
/// own (100), whose clock began before the vehicle's or after it. Five times a second it tells its field of
/// view (CAMERA_FOV_STATUS) in tenths of degrees, as its motors had it 0.05 s ago; the message is under way
/// for 20 to 80 ms, and the field of view is that of the nominal focal length: all are off by one error of 1
/// % (1 sigma).
Flight with_zoom(const Flight& flight, const ZoomSettings& settings, const CameraIntrinsics& camera,
                 std::uint64_t seed);

}  // namespace geoloc::sim
