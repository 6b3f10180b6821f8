// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/io/mavlink/camera_view.hpp"
#include "geoloc/pipeline/geolocator.hpp"

namespace geoloc::apps {

/// What the camera sees now, for the camera component. After a located frame.
io::CameraView camera_view(const Geolocator& geolocator, HostTime captured_at);

}  // namespace geoloc::apps
