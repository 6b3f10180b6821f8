// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace geoloc {

struct PaperTrackerConfig {
  double measurement_sigma_m = 1.2;  ///< 1-sigma of one fix an axis, calibration errors included (R)
  double process_sigma_m = 0.01;     ///< 1-sigma an axis added at every update: keeps the filter awake (Q)
  double gate = 3.0;                 ///< largest Mahalanobis distance (eq. 11) at which a pair is accepted
  int confirm_hits = 5;              ///< detections that make a tentative track a confirmed one
  int max_penalty = 15;              ///< a track that reaches it is removed
  double visible_margin_px =
      40.0;  ///< nearer to the image's edge a missing detection is not held against a track
  double merge_distance_m = 0.8;  ///< confirmed tracks that come closer are one object: an object's size
  int max_tracks = 2000;          ///< beyond this, new objects are refused and counted

  std::vector<std::string> problems() const;
};

}  // namespace geoloc
