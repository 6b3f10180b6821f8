// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "geoloc/io/dem/dem_file.hpp"

namespace geoloc::io {

Dem read_dem(const std::filesystem::path& file) {
  throw std::runtime_error(file.string() +
                           ": elevation models cannot be read: this geoloc was built without GDAL "
                           "(apt-get install libgdal-dev, and build anew)");
}

}  // namespace geoloc::io
