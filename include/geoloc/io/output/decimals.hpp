// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace geoloc::io {

/// The value rounded to `digits` decimal places, so that JSON writes it short and stable: as the shortest
/// decimal that reads back as the same value. Never -0. Values that are not finite stay so, and JSON writes
/// null.
inline double decimals(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale + 0.0;  // -0 + 0 is 0
}

}  // namespace geoloc::io
