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

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

/// What of this process lies in memory.
std::size_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0, resident_pages = 0;
  statm >> pages >> resident_pages;
  return resident_pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// As after a burst whose blocks lay between others that stay.
TEST(Memory, WhatABurstNeededIsGivenBack) {
  constexpr std::size_t kBlocks = 1000, kBlock_bytes = 64 << 10;  // 62 MiB
  std::vector<std::vector<char>> burst;
  std::vector<std::unique_ptr<int>> lasting;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    burst.emplace_back(kBlock_bytes, 'x');
    lasting.push_back(std::make_unique<int>(1));
  }
  const std::size_t at_most_bytes = resident_bytes();
  burst.clear();
  give_back_memory();
  EXPECT_LT(resident_bytes() + (50 << 20), at_most_bytes);
}

#endif

}  // namespace
}  // namespace geoloc::apps
