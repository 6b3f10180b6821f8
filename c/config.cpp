// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "field_setter.hpp"
#include "geoloc/projection/height_grid.hpp"
#include "handles.hpp"
#include "inputs.hpp"
#include "last_error.hpp"
#include "pipeline/geolocator_fields.hpp"

namespace geoloc::c {
namespace {

geoloc_status set(geoloc_config& config, const char* path, const SettingValue& value) {
  GeolocatorConfig changed = config.settings;
  FieldSetter setter(path, value);
  visit_fields(setter, changed);
  setter.require_set();
  config.settings = std::move(changed);
  return GEOLOC_OK;
}

/// A copy of an array that the caller owns; BadArgument for one that is too large to be meant.
template <typename T>
std::vector<T> copied(const T* values, std::size_t count, std::size_t at_most, const char* name) {
  if (count > at_most)
    throw BadArgument(std::string(name) + " holds more than " + std::to_string(at_most) + " values");
  if (count == 0) return {};
  return {&required(values, name), values + count};
}

}  // namespace
}  // namespace geoloc::c

extern "C" {

using namespace geoloc::c;

geoloc_config* geoloc_config_create(void) {
  std::unique_ptr<geoloc_config> config;
  guarded([&] {
    config = std::make_unique<geoloc_config>();
    return GEOLOC_OK;
  });
  return config.release();
}

void geoloc_config_destroy(geoloc_config* config) {
  delete config;
}

geoloc_status geoloc_config_set_number(geoloc_config* config, const char* path, double value) {
  return guarded([&] { return set(required(config, "config"), &required(path, "path"), value); });
}

geoloc_status geoloc_config_set_text(geoloc_config* config, const char* path, const char* value) {
  return guarded([&] {
    return set(required(config, "config"), &required(path, "path"), std::string(&required(value, "value")));
  });
}

geoloc_status geoloc_config_set_numbers(geoloc_config* config, const char* path, const double* values,
                                        size_t count) {
  constexpr std::size_t kLongest = 1000;
  return guarded([&] {
    return set(required(config, "config"), &required(path, "path"),
               copied(values, count, kLongest, "values"));
  });
}

geoloc_camera geoloc_camera_from_field_of_view(int32_t width_px, int32_t height_px,
                                               double horizontal_fov_deg) {
  geoloc::CameraConfig camera;
  camera.intrinsics = geoloc::CameraIntrinsics::from_field_of_view(width_px, height_px, horizontal_fov_deg);
  return to_c(camera);
}

geoloc_status geoloc_config_set_camera(geoloc_config* config, const geoloc_camera* camera) {
  return guarded([&] {
    required(config, "config").settings.camera = camera_from(required(camera, "camera"));
    return GEOLOC_OK;
  });
}

geoloc_status geoloc_config_set_terrain(geoloc_config* config, const geoloc_height_grid* grid) {
  constexpr std::size_t kMostNodes = std::size_t{1} << 28;
  return guarded([&] {
    const geoloc_height_grid& given = required(grid, "grid");
    if (given.rows > kMostNodes || given.columns > kMostNodes / std::max<std::size_t>(given.rows, 1))
      throw BadArgument("grid has more than " + std::to_string(kMostNodes) + " heights");
    const geoloc::HeightGrid::Layout layout{given.south_deg,          given.west_deg, given.latitude_step_deg,
                                            given.longitude_step_deg, given.rows,     given.columns};
    required(config, "config").settings.terrain = std::make_shared<const geoloc::HeightGrid>(
        layout, copied(given.heights_m, given.rows * given.columns, kMostNodes, "grid.heights_m"));
    return GEOLOC_OK;
  });
}
}
