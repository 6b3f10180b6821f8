// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "geoloc/geometry/angles.hpp"

namespace geoloc::sim {

/// Seeded random numbers that are the same on every platform; the standard library's distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }

  /// In [0, count).
  int index(int count) { return static_cast<int>(uniform(0.0, count)); }

  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

  /// Standard normal (Box-Muller).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return radius * std::cos(uniform(0.0, 2.0 * kPi));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace geoloc::sim
