// SPDX-License-Identifier: Apache-2.0
#include "app/resources.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <fstream>
#include <memory>
#include <vector>

namespace geoloc::apps {
namespace {

/// What of this process lies in memory.
double resident_MiB() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0.0, resident_pages = 0.0;
  statm >> pages >> resident_pages;
  return resident_pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

/// As after a burst whose blocks lay between others that stay.
TEST(Memory, WhatABurstNeededIsGivenBack) {
  constexpr std::size_t kBlocks = 1000, kBlock_bytes = 64 << 10;  // 62 MiB
  std::vector<std::vector<char>> burst;
  std::vector<std::unique_ptr<int>> lasting;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    burst.emplace_back(kBlock_bytes, 'x');
    lasting.push_back(std::make_unique<int>(1));
  }
  const double at_most_MiB = resident_MiB();
  burst.clear();
  give_back_memory();
  EXPECT_LT(resident_MiB(), at_most_MiB - 50.0);
}

#endif

}  // namespace
}  // namespace geoloc::apps
