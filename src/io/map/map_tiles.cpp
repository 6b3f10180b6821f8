// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/map/map_tiles.hpp"

#include <mutex>
#include <utility>

#include "io/gdal_dataset.hpp"
#include "io/map/map_raster.hpp"

namespace geoloc::io {

class MapTiles::Source {
 public:
  Source(MapRaster raster, std::string attribution)
      : raster_(std::move(raster)),
        area_(mercator_area(raster_.shown.get())),
        attribution_(std::move(attribution)) {}

  std::optional<std::string> tile(const TileAddress& address) {
    const MercatorArea wanted = area_of(address);
    if (!overlap(wanted, area_)) return std::nullopt;
    const std::lock_guard lock(mutex_);
    return cut_png(raster_.shown.get(), wanted);
  }

  const std::string& attribution() const { return attribution_; }

 private:
  std::mutex mutex_;  // GDAL's datasets are for one thread at a time
  MapRaster raster_;
  MercatorArea area_;
  std::string attribution_;
};

MapTiles::MapTiles(std::unique_ptr<Source> source) : source_(std::move(source)) {}
MapTiles::~MapTiles() = default;
MapTiles::MapTiles(MapTiles&&) noexcept = default;
MapTiles& MapTiles::operator=(MapTiles&&) noexcept = default;

namespace {

/// Names the file in whatever goes wrong.
template <class Make>
auto with_name(const std::filesystem::path& file, Make&& make) {
  try {
    return make();
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace

MapTiles MapTiles::picture(const std::filesystem::path& file) {
  return with_name(file, [&] {
    MapRaster raster = open_picture(file);
    std::string attribution = attribution_of(raster.file.get());
    return MapTiles(std::make_unique<Source>(std::move(raster), std::move(attribution)));
  });
}

MapTiles MapTiles::relief(const std::filesystem::path& file) {
  return with_name(file, [&] { return MapTiles(std::make_unique<Source>(open_relief(file), "")); });
}

std::optional<std::string> MapTiles::tile(const TileAddress& address) const {
  return source_->tile(address);
}

const std::string& MapTiles::attribution() const {
  return source_->attribution();
}

}  // namespace geoloc::io
