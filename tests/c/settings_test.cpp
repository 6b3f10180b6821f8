// SPDX-License-Identifier: Apache-2.0
// Every setting of the estimator is C's, too, under the path that docs/settings.md has it by.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "geoloc/geoloc.h"
#include "pipeline/geolocator_fields.hpp"

namespace geoloc {
namespace {

/// Sets what it visits through C, each to a value of its type.
class Setter {
 public:
  explicit Setter(geoloc_config* config, std::string path = {}) : config_(config), path_(std::move(path)) {}

  template <typename T, typename Rule>
  void field(const char* key, const T& value, const Rule&, const char*, const char*) {
    const std::string path = path_ + key;
    EXPECT_EQ(set(path.c_str(), value), GEOLOC_OK) << path << ": " << geoloc_last_error();
  }
  template <typename T>
  void section(const char* key, T& value) {
    Setter inner(config_, path_ + key + ".");
    visit_fields(inner, value);
  }
  template <typename T>
  void list(const char* key, std::vector<T>&, const char*) {
    for (const char* place : {"[0]", "[1]", "[0]"}) {
      T entry{};
      section((std::string(key) + place).c_str(), entry);
    }
  }
  void relation(const char*, double, bool, const char*) {}

 private:
  geoloc_status set(const char* path, double value) { return geoloc_config_set_number(config_, path, value); }
  geoloc_status set(const char* path, int value) { return geoloc_config_set_number(config_, path, value); }
  geoloc_status set(const char* path, const std::string& value) {
    return geoloc_config_set_text(config_, path, value.c_str());
  }
  geoloc_status set(const char* path, const std::array<double, 5>& values) {
    return geoloc_config_set_numbers(config_, path, values.data(), values.size());
  }
  geoloc_status set(const char* path, const std::vector<int>& values) {
    const std::vector<double> numbers(values.begin(), values.end());
    return geoloc_config_set_numbers(config_, path, numbers.data(), numbers.size());
  }
  template <typename Enum, typename = std::enable_if_t<std::is_enum_v<Enum>>>
  geoloc_status set(const char* path, Enum value) {
    return geoloc_config_set_text(config_, path, name_of(value));
  }

  geoloc_config* config_;
  std::string path_;
};

TEST(CSettings, TakeEverySettingOfTheEstimator) {
  geoloc_config* config = geoloc_config_create();
  GeolocatorConfig defaults;
  Setter setter(config);
  visit_fields(setter, defaults);
  geoloc_geolocator* geolocator = nullptr;
  EXPECT_EQ(geoloc_create(config, &geolocator), GEOLOC_OK) << geoloc_last_error();
  geoloc_destroy(geolocator);
  geoloc_config_destroy(config);
}

TEST(CSettings, NameEveryFaultOfValuesAsTheLibraryDoes) {
  geoloc_config* config = geoloc_config_create();
  ASSERT_EQ(geoloc_config_set_number(config, "joint.prior.sigma_latency_s", -1.0), GEOLOC_OK);
  ASSERT_EQ(geoloc_config_set_number(config, "camera.mount.pitch_deg", 1e4), GEOLOC_OK);
  ASSERT_EQ(geoloc_config_set_number(config, "known_points[0].latitude_deg", 100.0), GEOLOC_OK);
  geoloc_geolocator* geolocator = nullptr;
  EXPECT_EQ(geoloc_create(config, &geolocator), GEOLOC_INVALID_SETTING);

  GeolocatorConfig same;
  same.joint.prior.sigma_latency_s = -1.0;
  same.camera.mount.pitch_deg = 1e4;
  same.known_points.resize(1);
  same.known_points[0].position.latitude_deg = 100.0;
  std::string all;
  for (const std::string& problem : same.problems()) all += (all.empty() ? "" : "; ") + problem;
  EXPECT_EQ(same.problems().size(), 3u);
  EXPECT_EQ(geoloc_last_error(), all);
  geoloc_config_destroy(config);
}

}  // namespace
}  // namespace geoloc
