// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "geoloc/io/detection/tiles.hpp"

/// Any grid over a picture of any size: the tiles lie in the picture and cover it, and merging what was found
/// in them invents nothing.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace geoloc;
  if (size < 8) return 0;
  const io::ImageSize picture{1 + data[0] + 256 * data[1], 1 + data[2] + 256 * data[3]};
  io::DetectionConfig config;
  config.tile_columns = 1 + data[4] % 8;
  config.tile_rows = 1 + data[5] % 8;
  config.tile_overlap_px = data[6] * 16;
  int right = 0, bottom = 0;
  std::vector<io::TileDetections> found;
  std::size_t given = 0;
  for (const cv::Rect& tile : io::tiles_of(picture, config)) {
    if (tile.empty() || (cv::Rect{0, 0, picture.width_px, picture.height_px} & tile) != tile) std::abort();
    right = std::max(right, tile.br().x);
    bottom = std::max(bottom, tile.br().y);
    const double byte = data[7 + given % (size - 7)];
    const Box box{tile.x + byte / 256 * tile.width, tile.y + byte / 256 * tile.height, 1 + byte, 1 + byte};
    found.push_back({tile, {{box, byte / 256, data[7] % 3}}});
    ++given;
  }
  if (right != picture.width_px || bottom != picture.height_px) std::abort();
  if (io::merge_tiles(found, {}, picture, config).size() > given) std::abort();
  return 0;
}
