// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace geoloc::io {

/// Where a tile of a web map lies: at zoom z the world is 2^z x 2^z tiles, x from 180° west, y from the
/// north.
struct TileAddress {
  int z = 0;
  int x = 0;
  int y = 0;
};

/// "17/70400/73939". nullopt for what is not that, or no tile of the world.
std::optional<TileAddress> parse_tile_address(const std::string& text);

/// The largest zoom that is served: 2 cm per pixel at the equator.
inline constexpr int kMostTileZoom = 23;

/// A map in a file, cut into the tiles of web maps (Web Mercator, 256 px). Thread-safe; one tile is made at a
/// time, in some 10 ms.
class MapTiles {
 public:
  /// An orthophoto or a scanned map (GeoTIFF in any projection, with one, three or four bands of 8 bits) or a
  /// file of tiles (MBTiles of pictures). Throws std::runtime_error naming the file and the reason.
  static MapTiles picture(const std::filesystem::path& file);

  /// An elevation model as a relief, shaded from the north-west.
  static MapTiles relief(const std::filesystem::path& file);

  ~MapTiles();
  MapTiles(MapTiles&&) noexcept;
  MapTiles& operator=(MapTiles&&) noexcept;

  /// PNG; nullopt beside the map, and where the file is damaged.
  std::optional<std::string> tile(const TileAddress& address) const;

  /// What its maker wants to be read beside it; empty where the file tells nothing.
  const std::string& attribution() const;

 private:
  class Source;
  explicit MapTiles(std::unique_ptr<Source> source);

  std::unique_ptr<Source> source_;
};

}  // namespace geoloc::io
