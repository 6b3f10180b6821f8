// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace geoloc::sim {

/// What a run draws for. Each use has a stream of its own, so that changing one rate leaves every other draw
/// alone.
enum class RandomStream : std::uint64_t {
  kScenario = 1,
  kMount,
  kTiming,
  kDetections,
  kClutter,
  kLink,
  kScene,
  kRangefinder,
  kGimbal,
  kZoom
};

/// Seed of one stream of a run (splitmix64): neighbouring seeds give unrelated streams.
constexpr std::uint64_t stream_seed(std::uint64_t seed, RandomStream stream) {
  const auto mix = [](std::uint64_t value) {
    value += 0x9e3779b97f4a7c15U;
    value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
    value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
    return value ^ (value >> 31U);
  };
  return mix(seed ^ mix(static_cast<std::uint64_t>(stream)));
}

}  // namespace geoloc::sim
