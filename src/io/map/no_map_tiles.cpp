// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "geoloc/io/map/map_tiles.hpp"

namespace geoloc::io {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw std::runtime_error(file.string() +
                           ": maps cannot be read: this geoloc was built without GDAL (apt-get install "
                           "libgdal-dev, and build anew)");
}

const std::string kNoAttribution;

}  // namespace

class MapTiles::Source {};

MapTiles::MapTiles(std::unique_ptr<Source> source) : source_(std::move(source)) {}
MapTiles::~MapTiles() = default;
MapTiles::MapTiles(MapTiles&&) noexcept = default;
MapTiles& MapTiles::operator=(MapTiles&&) noexcept = default;

MapTiles MapTiles::picture(const std::filesystem::path& file) {
  refuse(file);
}

MapTiles MapTiles::relief(const std::filesystem::path& file) {
  refuse(file);
}

std::optional<std::string> MapTiles::tile(const TileAddress& /*address*/) const {
  return std::nullopt;
}

const std::string& MapTiles::attribution() const {
  return kNoAttribution;
}

}  // namespace geoloc::io
