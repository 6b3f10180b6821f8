// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/camera/camera.hpp"
#include "geoloc/io/mavlink/link_status.hpp"

namespace geoloc::apps {

/// What a user is told where the camera says that it sees more than the configured one does, or where it says
/// from the beginning on that it sees less; empty where the two agree to some percent.
std::string view_contradiction(const io::LinkStatus& link, const CameraIntrinsics& configured);

}  // namespace geoloc::apps
