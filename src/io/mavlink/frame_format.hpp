// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

// MAVLink's frames: https://mavlink.io/en/guide/serialization.html
namespace geoloc::io {

inline constexpr std::uint8_t kMagicV1 = 0xFE;
inline constexpr std::uint8_t kMagicV2 = 0xFD;
inline constexpr std::size_t kHeaderSizeV1 = 6;
inline constexpr std::size_t kHeaderSizeV2 = 10;
inline constexpr std::size_t kChecksumSize = 2;
inline constexpr std::size_t kSignatureSize = 13;
/// The only defined incompatibility flag; a frame with another one cannot be read.
inline constexpr std::uint8_t kSignedFlag = 0x01;

}  // namespace geoloc::io
