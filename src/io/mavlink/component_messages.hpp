// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/io/mavlink/messages.hpp"

namespace geoloc::io {

// What gimbals and cameras tell of themselves, each message of its own kind.
Message decode_gimbal_device(const Frame& frame);
Message decode_mount_orientation(const Frame& frame);
Message decode_mount_status(const Frame& frame);
Message decode_field_of_view(const Frame& frame);
Message decode_camera_settings(const Frame& frame);

}  // namespace geoloc::io
