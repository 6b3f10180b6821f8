// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/camera/camera.hpp"
#include "geoloc/pipeline/geolocator_config.hpp"

// What Python passes as JSON. Faults, all of them, throw std::invalid_argument.
namespace geoloc::python {

GeolocatorConfig config_from(const std::string& settings_json);
CameraMount mount_from(const std::string& mount_json);

}  // namespace geoloc::python
