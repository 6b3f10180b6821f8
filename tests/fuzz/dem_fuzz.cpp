// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "geoloc/io/dem/dem_file.hpp"

namespace {

/// Formats are told from the name as well: the first byte chooses.
std::filesystem::path file_for(std::uint8_t first) {
  constexpr std::array<const char*, 4> kNames{"dem.tif", "dem.asc", "N46E007.hgt", "n46.dt1"};
  const auto folder =
      std::filesystem::temp_directory_path() / ("geoloc_dem_fuzz." + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  return folder / kNames[first % kNames.size()];
}

void check(const geoloc::HeightGrid& grid) {
  if (!(std::abs(grid.least_m()) <= 12e3) || !(std::abs(grid.greatest_m()) <= 12e3)) std::abort();
  if (!(grid.spacing_m() > 0.0)) std::abort();
  const auto& layout = grid.layout();
  for (const double share : {-1.0, 0.0, 0.3, 1.0, 2.0}) {
    const auto here =
        grid.at({layout.south_deg + share * static_cast<double>(layout.rows) * layout.latitude_step_deg,
                 layout.west_deg + share * static_cast<double>(layout.columns) * layout.longitude_step_deg});
    if (here && !(std::isfinite(here->height_m) && here->beyond_m >= 0.0)) std::abort();
  }
}

}  // namespace

/// Any bytes as an elevation model are read or refused, and what is read are heights on Earth.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::filesystem::path file = file_for(data[0]);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  try {
    check(*geoloc::io::read_dem(file).heights);
  } catch (const std::runtime_error&) {
  }
  std::filesystem::remove(file);
  return 0;
}
