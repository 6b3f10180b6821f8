// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/sei/sei_unit.hpp"

#include <gtest/gtest.h>

#include <string>

#include "geoloc/io/sei/video_telemetry.hpp"

namespace geoloc::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// What a decoder reads in a unit of the byte stream: the start code off, and each 3 that follows two zeros.
Bytes unprotected(const Bytes& unit) {
  Bytes content;
  int zeros = 0;
  for (std::size_t i = 4; i < unit.size(); ++i) {
    if (zeros >= 2 && unit[i] == 3) {
      zeros = 0;
      continue;
    }
    zeros = unit[i] == 0 ? zeros + 1 : 0;
    content.push_back(unit[i]);
  }
  return content;
}

TEST(SeiUnit, ItIsTypeFiveWithItsSizeTheUuidAndTheData) {
  const Bytes content = unprotected(sei_unit(kTelemetryUuid, "abc"));
  Bytes expected{6, 5, 19};
  expected.insert(expected.end(), kTelemetryUuid.begin(), kTelemetryUuid.end());
  for (const std::uint8_t byte : {'a', 'b', 'c', '\x80'}) expected.push_back(byte);
  EXPECT_EQ(content, expected);
}

TEST(SeiUnit, SizesBeyondAByteAreCountedInBytesOf255) {
  for (const std::size_t size : {238U, 239U, 240U, 494U, 1000U}) {
    const Bytes content = unprotected(sei_unit(kTelemetryUuid, std::string(size, 'x')));
    std::size_t told = 0, at = 2;
    for (; content[at] == 255; ++at) told += 255;
    told += content[at];
    EXPECT_EQ(told, 16 + size);
    EXPECT_EQ(content.size(), at + 1 + told + 1);
  }
}

TEST(SeiUnit, NoStartCodeStandsInIt) {
  const std::string data("\0\0\0\0\0\1\0\0\2\0\0\3\0\0", 14);
  const Bytes unit = sei_unit(kTelemetryUuid, data);
  for (std::size_t i = 4; i + 2 < unit.size(); ++i)
    EXPECT_FALSE(unit[i] == 0 && unit[i + 1] == 0 && unit[i + 2] < 3) << i;
  const Bytes content = unprotected(unit);
  EXPECT_EQ(std::string(content.end() - 15, content.end() - 1), data);
}

TEST(SeiUnit, PicturesBeginAtTheirFirstSlice) {
  const Bytes unit{0, 0, 0, 1, 9, 0xf0, 0, 0, 0, 1, 0x67, 0x42, 0, 0, 1, 0x68, 0xce, 0, 0, 0, 1, 0x65, 0x88};
  EXPECT_EQ(first_slice(unit.data(), unit.size()), 17U);
  const Bytes short_code{0, 0, 1, 0x41, 0x9a};
  EXPECT_EQ(first_slice(short_code.data(), short_code.size()), 0U);
}

TEST(SeiUnit, WithoutASliceTheEndIsTold) {
  for (const Bytes& unit : {Bytes{}, Bytes{0}, Bytes{0, 0, 1}, Bytes{0, 0, 1, 6},
                            Bytes{0, 0, 0, 1, 0x67, 0x42}, Bytes(100, 0), Bytes(100, 1)})
    EXPECT_EQ(first_slice(unit.data(), unit.size()), unit.size());
}

}  // namespace
}  // namespace geoloc::io
