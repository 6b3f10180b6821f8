// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "geoloc/geometry/time.hpp"

namespace geoloc::io {

inline VehicleTime boot_time(std::uint32_t time_boot_ms) {
  return VehicleTime{std::chrono::milliseconds{time_boot_ms}};
}

/// But for what single precision rounds. False for NaN.
inline bool is_unit(const Eigen::Quaterniond& q) {
  constexpr double kTolerance = 0.01;
  return std::abs(q.norm() - 1.0) <= kTolerance;
}

}  // namespace geoloc::io
