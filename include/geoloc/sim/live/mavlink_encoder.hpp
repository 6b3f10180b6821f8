// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geoloc/io/mavlink/frame.hpp"

namespace geoloc::sim {

using Datagram = std::vector<std::uint8_t>;

/// A payload as long as MAVLink allows; what MAVLink 2 cut off is zero.
using Payload = std::array<std::uint8_t, 255>;

/// A frame; empty for a message of no dialect that the generated headers know, and for one whose number
/// version 1 does not reach.
Datagram encode_frame(std::uint32_t message_id, io::MavAddress sender, std::uint8_t sequence,
                      const Payload& payload, bool use_v2 = true);

}  // namespace geoloc::sim
