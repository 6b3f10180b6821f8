// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

// A number drawn into a picture as black and white cells that survive a video codec: 64 bits and a check byte
// in nine rows of eight cells from the top-left corner.
namespace geoloc::io::test {

constexpr int kCellPx = 16;
constexpr int kCellsPerRow = 8;
constexpr int kCells = 72;

inline std::uint8_t check_byte(std::uint64_t value) {
  std::uint8_t sum = 0x5a;
  for (int byte = 0; byte < 8; ++byte)
    sum = static_cast<std::uint8_t>(sum * 31U + ((value >> (8 * byte)) & 0xffU));
  return sum;
}

inline bool bit_of_cell(std::uint64_t value, int cell) {
  return cell < 64 ? ((value >> cell) & 1U) != 0 : ((check_byte(value) >> (cell - 64)) & 1U) != 0;
}

/// Draws into an 8-bit plane of at least 128 x 144 pixels.
inline void draw_number(std::uint8_t* plane, std::size_t stride, std::uint64_t value) {
  for (int row = 0; row < kCells / kCellsPerRow * kCellPx; ++row) {
    for (int column = 0; column < kCellsPerRow * kCellPx; ++column) {
      const bool bit = bit_of_cell(value, row / kCellPx * kCellsPerRow + column / kCellPx);
      plane[static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column)] = bit ? 235 : 16;
    }
  }
}

}  // namespace geoloc::io::test
