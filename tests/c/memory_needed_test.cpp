// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstddef>

#include "geoloc/geoloc.h"
#include "support/heap_ledger.hpp"

namespace geoloc {
namespace {

TEST(MemoryNeededInC, IsWhatCreatingAsksOfTheHeapToTheByte) {
  geoloc_config* const config = geoloc_config_create();
  for (const char* method : {"joint", "paper"}) {
    for (const double max_detections : {20.0, 256.0}) {
      ASSERT_EQ(geoloc_config_set_text(config, "method", method), GEOLOC_OK);
      ASSERT_EQ(geoloc_config_set_number(config, "max_detections", max_detections), GEOLOC_OK);
      std::size_t told = 0;
      ASSERT_EQ(geoloc_memory_needed(config, &told), GEOLOC_OK);
      const testing::HeapLedger ledger;
      geoloc_geolocator* geolocator = nullptr;
      ASSERT_EQ(geoloc_create(config, &geolocator), GEOLOC_OK);
      EXPECT_EQ(ledger.held_bytes(), told) << method << " " << max_detections;
      geoloc_destroy(geolocator);
      EXPECT_EQ(ledger.held_bytes(), 0u);
    }
  }
  geoloc_config_destroy(config);
}

}  // namespace
}  // namespace geoloc
