// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "geoloc/sim/world/scene.hpp"
#include "mip_atlas.hpp"

namespace geoloc::sim {

/// The ground's look is patches * grain / kGrainUnity. Both repeat, with periods that do not fit into each
/// other and axes turned against each other, so that no place of a flight looks like another.
struct Ground {
  MipAtlas patches;  ///< colour, features over 0.3 m
  MipAtlas grain;    ///< a factor a channel, features up to 1 m
};

inline constexpr double kGrainUnity = 128.0;  ///< grey level of the grain that changes nothing

/// Some tenths of a second of work; the result is immutable and may be shared by cameras.
std::shared_ptr<const Ground> make_ground(GroundStyle style, std::uint64_t seed);

}  // namespace geoloc::sim
