// SPDX-License-Identifier: Apache-2.0
#include "fuzz/hostile_stills.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

#include "support/source_tree.hpp"
#include "support/spoilt_bytes.hpp"

namespace geoloc::io {
namespace {

using Reader = void (*)(const std::string&);

std::string bytes_of(const std::string& name) {
  std::ifstream file(source_tree() / "tests" / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void spoil_and_read(const std::string& good, Reader read) {
  ASSERT_FALSE(good.empty());
  std::mt19937 random(1);
  read("");
  read(good);
  for (int i = 0; i < 2000; ++i) read(testing::spoilt(good, random));
  for (std::size_t size = 0; size < good.size(); size += 1 + good.size() / 200) read(good.substr(0, size));
}

TEST(HostileStills, Pictures) {
  spoil_and_read(bytes_of("data/stills/dji.jpg"), &hostile::read_any_still);
}

TEST(HostileStills, Packets) {
  spoil_and_read(bytes_of("fuzz/seeds/xmp/dji.xml"), &hostile::read_any_xmp);
}

TEST(HostileStills, Labels) {
  spoil_and_read(bytes_of("fuzz/seeds/labels/gcp_list.txt"), &hostile::read_any_labels);
  spoil_and_read(bytes_of("fuzz/seeds/labels/table.csv"), &hostile::read_any_labels);
  spoil_and_read(bytes_of("fuzz/seeds/labels/detected.jsonl"), &hostile::read_any_labels);
}

}  // namespace
}  // namespace geoloc::io
