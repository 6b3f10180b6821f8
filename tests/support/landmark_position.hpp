// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/LU>

#include "calibration/landmark.hpp"

namespace geoloc {

inline Point position_of(const Landmark& landmark, const CalibrationVector& calibration,
                         const DriftTimeline& drift) {
  return landmark.A().inverse() * landmark.weighted_position(calibration, drift);
}

}  // namespace geoloc
