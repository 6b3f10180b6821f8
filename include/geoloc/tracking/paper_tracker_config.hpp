// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace geoloc {

/// Settings of PaperTracker (docs/settings.md).
struct PaperTrackerConfig {
  double measurement_sigma_m = 1.2;  ///< R
  double process_sigma_m = 0.01;     ///< Q
  double gate = 3.0;                 ///< Mahalanobis distance (eq. 11)
  int confirm_hits = 5;
  int max_penalty = 15;  ///< misses, less hits, that remove an object
  double visible_margin_px = 40.0;
  double merge_distance_m = 0.8;
  int max_tracks = 2000;

  std::vector<std::string> problems() const;
};

}  // namespace geoloc
