// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibration/noise_estimate.hpp"
#include "geoloc/geometry/angles.hpp"

namespace geoloc::testing {

/// The noise of a vehicle about which nothing was learnt.
inline const NoiseEstimate kNoise(0.1 * kRadPerDeg);

}  // namespace geoloc::testing
