// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace geoloc::sim {

inline constexpr std::uint32_t kAttitudeId = 30;

/// The parts of one raw MAVLink frame, version 1 or 2; points into it. The checksum is not looked at.
struct FrameView {
  std::uint32_t message_id = 0;
  std::uint8_t system_id = 0;
  std::uint8_t component_id = 0;
  const std::uint8_t* payload = nullptr;  ///< version 2 cuts trailing zeros off
  std::size_t payload_size = 0;
};

/// nullopt where the bytes are no frame or less than the frame they announce.
inline std::optional<FrameView> view_frame(const std::uint8_t* frame, std::size_t size) {
  constexpr std::uint8_t kMagicV1 = 0xFE, kMagicV2 = 0xFD;
  constexpr std::size_t kHeaderV1 = 6, kHeaderV2 = 10, kChecksum = 2;
  if (size < 2) return std::nullopt;
  const std::size_t header = frame[0] == kMagicV1 ? kHeaderV1 : kHeaderV2;
  if ((frame[0] != kMagicV1 && frame[0] != kMagicV2) || size < header + frame[1] + kChecksum)
    return std::nullopt;
  if (frame[0] == kMagicV1) return FrameView{frame[5], frame[3], frame[4], frame + header, frame[1]};
  const std::uint32_t id = frame[7] | std::uint32_t{frame[8]} << 8U | std::uint32_t{frame[9]} << 16U;
  return FrameView{id, frame[5], frame[6], frame + header, frame[1]};
}

/// Little-endian, as MAVLink's payloads are; four bytes must be there.
inline std::uint32_t load_u32(const std::uint8_t* bytes) {
  return bytes[0] | std::uint32_t{bytes[1]} << 8U | std::uint32_t{bytes[2]} << 16U |
         std::uint32_t{bytes[3]} << 24U;
}

}  // namespace geoloc::sim
