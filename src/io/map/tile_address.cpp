// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <charconv>

#include "geoloc/io/map/map_tiles.hpp"

namespace geoloc::io {

std::optional<TileAddress> parse_tile_address(const std::string& text) {
  std::array<int, 3> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && (at == end || *at++ != '/')) return std::nullopt;
    const auto [stopped_at, error] = std::from_chars(at, end, numbers[i]);
    if (error != std::errc{}) return std::nullopt;
    at = stopped_at;
  }
  const auto [z, x, y] = numbers;
  const bool is_tile = z >= 0 && z <= kMostTileZoom && x >= 0 && y >= 0 && x < (1 << z) && y < (1 << z);
  return at == end && is_tile ? std::optional(TileAddress{z, x, y}) : std::nullopt;
}

}  // namespace geoloc::io
