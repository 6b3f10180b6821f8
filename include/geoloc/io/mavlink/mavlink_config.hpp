// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace geoloc::io {

/// "mavlink" in the configuration file.
struct MavlinkConfig {
  int system_id = 0;       ///< of the vehicle; 0: the autopilot that sends state (VehicleChoice)
  int component_id = 191;  ///< our own, in the vehicle's system; 191 is that of an onboard computer
  double attitude_rate_hz = 10.0;
  double position_rate_hz = 10.0;
  double fast_rate_hz =
      50.0;  ///< of attitude, position and gimbal where the link bears it (LinkPace); 0: never
  double rangefinder_rate_hz = 0.0;  ///< 0: what comes is used, but not requested
  double gimbal_rate_hz = 10.0;      ///< of a camera that is on one; 0: what comes is used, but not requested
  int gimbal = 0;                    ///< GimbalDevice::number(); 0: the first one heard
  double zoom_rate_hz = 5.0;  ///< of a camera's field of view; 0: what comes is used, but not requested
  int zoom_camera = 0;        ///< CameraReceiver's number; 0: the first one heard
  double link_timeout_s = 3.0;
  std::string signing_key_file;    ///< empty: nothing is signed, and nothing checked
  std::string signing_state_file;  ///< keeps the stamps over restarts; empty: beside the key
  bool camera = false;             ///< be a camera of the vehicle that tells where objects are
  int camera_component_id = 105;   ///< 100-105 are cameras; the vehicle's own is mostly 100
  bool status_text = false;        ///< tell ground stations of each object that is confirmed

  /// Every fault, named by its path; empty where the settings can be used.
  std::vector<std::string> problems() const;
};

}  // namespace geoloc::io
