// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/geoloc.h"
#include "geoloc/geoloc.hpp"

// The library's values of C's structures, and back. What cannot be one throws BadArgument, which names it.
namespace geoloc::c {

geoloc_camera to_c(const CameraConfig& camera);

/// Numbers out of range are the settings' matter, which names them all.
CameraConfig camera_from(const geoloc_camera& camera);

AttitudeSample sample_from(const geoloc_attitude& attitude);
PositionSample sample_from(const geoloc_position& position);
GimbalSample sample_from(const geoloc_gimbal& gimbal);
FieldOfViewSample sample_from(const geoloc_field_of_view& field_of_view);
RangeSample sample_from(const geoloc_range& range);

/// Into a frame that is reused.
void fill(FrameDetections& frame, const geoloc_frame& given);

FrameWait wait_from(int32_t wait);

}  // namespace geoloc::c
