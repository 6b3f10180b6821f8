// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <string>

#include "geoloc/pipeline/geolocator.hpp"
#include "support/heap_ledger.hpp"

namespace geoloc {
namespace {

/// Any configuration that decides of memory, and is one.
GeolocatorConfig any_config(std::mt19937& random) {
  const auto between = [&](int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random);
  };
  GeolocatorConfig config;
  config.method = between(0, 3) == 0 ? Method::kPaper : Method::kJoint;
  config.max_detections = between(1, 600);
  config.joint.max_tracks = between(1, 3000);
  config.paper.max_tracks = between(1, 3000);
  config.joint.drift.max_nodes = between(4, 80);
  config.joint.drift.max_spells = between(0, 8);
  for (int i = between(0, 3); i > 0; --i) config.joint.moving.classes.push_back(i);
  for (int i = between(-3, 6); i > 0; --i) {
    KnownPoint point;
    point.name = std::string(static_cast<std::size_t>(between(1, 40)), 'n') + std::to_string(i);
    point.position = {47.4 + 1e-3 * i, 8.5};
    config.known_points.push_back(point);
  }
  return config;
}

TEST(MemoryNeeded, IsWhatConstructionAsksOfTheHeapToTheByte) {
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    const GeolocatorConfig config = any_config(random);
    ASSERT_EQ(config.problems(), std::vector<std::string>{});
    const std::size_t told = Geolocator::memory_needed(config);
    const testing::HeapLedger ledger;
    const Geolocator geolocator(config);
    ASSERT_EQ(ledger.held_bytes(), told)
        << "configuration " << i << ", joint: " << (config.method == Method::kJoint)
        << ", known points: " << config.known_points.size()
        << ", moving classes: " << config.joint.moving.classes.size();
  }
}

/// Of the largest configuration, too, which no computer could hold.
TEST(MemoryNeeded, IsToldWithoutTakingIt) {
  GeolocatorConfig config;
  config.max_detections = 10'000;
  config.joint.max_tracks = 1'000'000;
  ASSERT_EQ(config.problems(), std::vector<std::string>{});
  const testing::HeapLedger ledger;
  EXPECT_GT(Geolocator::memory_needed(config), std::size_t{1'000'000'000});
  EXPECT_EQ(ledger.held_bytes(), 0u);
  EXPECT_LT(ledger.most_bytes(), 10'000u);
}

TEST(MemoryNeeded, IsNotToldOfWhatCannotBeBuilt) {
  GeolocatorConfig config;
  config.max_detections = -1;
  EXPECT_THROW((void)Geolocator::memory_needed(config), std::invalid_argument);
}

}  // namespace
}  // namespace geoloc
