// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/camera/camera.hpp"
#include "geoloc/io/mavlink/camera_view.hpp"
#include "geoloc/io/mavlink/commands.hpp"
#include "geoloc/io/mavlink/messages.hpp"

namespace geoloc::io {

/// Writes the messages of a camera component in MAVLink 2, because most of them do not exist in MAVLink 1.
/// Each call uses one sequence number.
class CameraWriter {
 public:
  OutgoingFrame heartbeat(MavAddress self);
  OutgoingFrame command_ack(MavAddress self, MavAddress to, std::uint16_t command, std::uint8_t result);

  /// CAMERA_INFORMATION: tracks points of the image and reports their geographic position.
  OutgoingFrame information(MavAddress self, VehicleTime time, const CameraIntrinsics& image);

  /// CAMERA_FOV_STATUS.
  OutgoingFrame field_of_view(MavAddress self, const CameraView& view, const CameraIntrinsics& image);

  /// CAMERA_TRACKING_GEO_STATUS; without a target the camera is idle.
  OutgoingFrame tracking(MavAddress self, const CameraTarget* target);

 private:
  std::uint8_t sequence_ = 0;
};

}  // namespace geoloc::io
