// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/geoloc.h"
#include "geoloc/geoloc.hpp"

struct geoloc_config {
  geoloc::GeolocatorConfig settings;
};

struct geoloc_geolocator {
  explicit geoloc_geolocator(const geoloc::GeolocatorConfig& settings) : estimator(settings) {
    frame.detections.reserve(settings.max_detections);
  }

  geoloc::Geolocator estimator;
  geoloc::FrameDetections frame;  // reused, so that adding one does not allocate
};
