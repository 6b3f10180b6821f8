// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"

namespace geoloc::io {

/// The object of camera.json (docs/formats.md): width height fx fy cx cy distortion[k1 k2 p1 p2 k3] mount{…}.
nlohmann::ordered_json camera_to_json(const CameraConfig& camera);

/// Reads that object over `camera`. In place of fx fy cx cy it takes `horizontal_fov_deg`. Extra keys are
/// rejected only if `strict`. Faults are added to `problems` with their paths below `path`.
void camera_from_json(const nlohmann::json& object, const std::string& path, bool strict,
                      CameraConfig& camera, std::vector<std::string>& problems);

/// The mount alone, as under "mount" there.
nlohmann::ordered_json mount_to_json(const CameraMount& mount);
void mount_from_json(const nlohmann::json& object, const std::string& path, CameraMount& mount,
                     std::vector<std::string>& problems);

}  // namespace geoloc::io
