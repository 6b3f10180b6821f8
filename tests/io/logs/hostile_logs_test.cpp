// SPDX-License-Identifier: Apache-2.0
#include "fuzz/hostile_logs.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "support/source_tree.hpp"
#include "support/spoilt_bytes.hpp"

namespace geoloc::io {
namespace {

using Reader = void (*)(std::string_view);

std::string seed(const std::string& name) {
  std::ifstream file(source_tree() / "tests/fuzz/seeds" / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void spoil_and_read(const std::string& name, Reader read) {
  const std::string good = seed(name);
  ASSERT_FALSE(good.empty()) << name;
  std::mt19937 random(1);
  read("");
  read(good);
  for (int i = 0; i < 2000; ++i) read(testing::spoilt(good, random));
  for (std::size_t size = 0; size < good.size(); ++size) read(std::string_view(good).substr(0, size));
}

TEST(HostileLogs, Dataflash) {
  spoil_and_read("dataflash/flight.BIN", &hostile::read_any_dataflash);
}

TEST(HostileLogs, Ulog) {
  spoil_and_read("ulog/flight.ulg", &hostile::read_any_ulog);
}

TEST(HostileLogs, Subtitles) {
  spoil_and_read("srt/gimbal.SRT", &hostile::read_any_srt);
  spoil_and_read("srt/old.SRT", &hostile::read_any_srt);
}

TEST(HostileLogs, Tables) {
  spoil_and_read("log_table/flight.csv", &hostile::read_any_log_table);
}

}  // namespace
}  // namespace geoloc::io
