// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace geoloc::sim {

/// A number in [0, 1) that depends on nothing but its arguments.
inline float hashed_unit(std::uint32_t seed, std::uint32_t which) {
  std::uint32_t bits = seed * 0x9E3779B1u ^ (which + 0x7F4A7C15u) * 0x85EBCA77u;
  bits = (bits ^ (bits >> 15)) * 0x2C1B3C6Du;
  bits = (bits ^ (bits >> 12)) * 0x297A2D39u;
  return static_cast<float>((bits ^ (bits >> 15)) >> 8) * 0x1.0p-24f;
}

/// Smooth noise in [0, 1), one value per unit square, cubic in between.
inline float value_noise(float x, float y, std::uint32_t seed) {
  const float column = std::floor(x), row = std::floor(y);
  const auto corner = [&](float right, float up) {
    const auto i = static_cast<std::uint32_t>(static_cast<std::int32_t>(column + right));
    const auto j = static_cast<std::uint32_t>(static_cast<std::int32_t>(row + up));
    return hashed_unit(seed, i * 0x27D4EB2Fu + j * 0x165667B1u);
  };
  const auto smooth = [](float t) { return t * t * (3.0f - 2.0f * t); };
  const float across = smooth(x - column), along = smooth(y - row);
  const float low = corner(0, 0) + across * (corner(1, 0) - corner(0, 0));
  const float high = corner(0, 1) + across * (corner(1, 1) - corner(0, 1));
  return low + along * (high - low);
}

}  // namespace geoloc::sim
