// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "geoloc/geoloc.h"
#include "geoloc/geoloc.hpp"

struct geoloc_config {
  geoloc::GeolocatorConfig settings;
};

struct geoloc_geolocator {
  explicit geoloc_geolocator(const geoloc::GeolocatorConfig& settings) : estimator(settings) {
    frame.detections.reserve(settings.max_detections);
  }

  /// Of the heap.
  static std::size_t bytes(const geoloc::GeolocatorConfig& settings) {
    return geoloc::Geolocator::memory_needed(settings) + sizeof(geoloc_geolocator) +
           settings.max_detections * sizeof(geoloc::Detection);
  }

  geoloc::Geolocator estimator;
  geoloc::FrameDetections frame;  // reused, so that adding one does not allocate
};
