// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "geoloc/geometry/time.hpp"

namespace geoloc::sim {

/// How far a camera had truly zoomed in at any time of a flight: 1 is its calibration. It runs evenly, by a
/// factor a second, from one sample to the next.
class ZoomTrajectory {
 public:
  using Sample = std::pair<VehicleTime, double>;

  /// Throws std::invalid_argument unless there are two samples at least, their times rise, and zooms are
  /// above 0.
  explicit ZoomTrajectory(std::vector<Sample> samples);

  /// Before and after the samples it stays as it was at the end.
  double zoom(VehicleTime time) const;

 private:
  std::vector<Sample> samples_;
};

}  // namespace geoloc::sim
