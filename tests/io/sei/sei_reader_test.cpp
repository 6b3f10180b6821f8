// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/sei/sei_reader.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "geoloc/io/sei/sei_unit.hpp"
#include "geoloc/io/sei/video_telemetry.hpp"

namespace geoloc::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A unit of H.265 without a start code: that of H.264, whose header is a byte shorter.
Bytes unit_of(const std::string& data, std::uint8_t type = 39) {
  const Bytes h264 = sei_unit(kTelemetryUuid, data);
  Bytes unit{static_cast<std::uint8_t>(type << 1U), 1};
  unit.insert(unit.end(), h264.begin() + 5, h264.end());
  return unit;
}

Bytes as_stream(const std::vector<Bytes>& units, bool is_long) {
  Bytes stream;
  for (const Bytes& unit : units) {
    if (is_long) stream.push_back(0);
    stream.insert(stream.end(), {0, 0, 1});
    stream.insert(stream.end(), unit.begin(), unit.end());
  }
  return stream;
}

Bytes as_counted(const std::vector<Bytes>& units) {
  Bytes counted;
  for (const Bytes& unit : units) {
    for (const unsigned shift : {24U, 16U, 8U, 0U})
      counted.push_back(static_cast<std::uint8_t>(unit.size() >> shift));
    counted.insert(counted.end(), unit.begin(), unit.end());
  }
  return counted;
}

std::optional<std::string> read_stream(const Bytes& picture) {
  return unregistered_data_h265(kTelemetryUuid, UnitPrefix::kStartCode, picture.data(), picture.size());
}

std::optional<std::string> read_counted(const Bytes& picture) {
  return unregistered_data_h265(kTelemetryUuid, UnitPrefix::kLength, picture.data(), picture.size());
}

const Bytes kParameters{0x40, 0x01, 0x0c}, kSlice{0x26, 0x01, 0xaf, 0x00, 0x00, 0x03, 0x01};

TEST(SeiReader, FindsTheDataInEitherForm) {
  for (const std::string& data : {std::string("abc"), std::string(), std::string(700, 'x'),
                                  std::string(9, '\0'), std::string("\0\0\1\0\0\3\0\0", 8)}) {
    const std::vector<Bytes> units{kParameters, unit_of(data), kSlice};
    EXPECT_EQ(read_stream(as_stream(units, false)), data);
    EXPECT_EQ(read_stream(as_stream(units, true)), data);
    EXPECT_EQ(read_counted(as_counted(units)), data);
  }
}

TEST(SeiReader, TheLastOneCountsOfPrefixesAndSuffixes) {
  const std::vector<Bytes> units{unit_of("first"), kSlice, unit_of("last", 40)};
  EXPECT_EQ(read_counted(as_counted(units)), "last");
  EXPECT_EQ(read_stream(as_stream(units, true)), "last");
}

TEST(SeiReader, WhatIsNotOursTellsNothing) {
  Bytes other = unit_of("abc");
  other[4] ^= 1;  // of the UUID
  Bytes timing = unit_of("abc");
  timing[2] = 1;  // payload type
  for (const Bytes& unit : {other, timing, unit_of("abc", 1), unit_of(std::string(70'000, 'x')), kSlice})
    EXPECT_FALSE(read_counted(as_counted({kParameters, unit})));
}

TEST(SeiReader, LengthsThatLookLikeStartCodesAreLengths) {
  const Bytes picture = as_counted({unit_of(std::string(300, 'x')), kSlice});
  ASSERT_EQ(Bytes(picture.begin(), picture.begin() + 3), (Bytes{0, 0, 1}));
  EXPECT_EQ(read_counted(picture), std::string(300, 'x'));
}

/// Every beginning of a picture, and copies with a byte that is another.
template <typename Read>
void read_damaged(const Bytes& whole, const Read& read) {
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto found = read({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_EQ(found.value_or(std::string(300, 'x')), std::string(300, 'x'));
    for (const std::uint8_t byte : Bytes{0, 1, 255}) {
      Bytes damaged = whole;
      damaged[size] = byte;
      read(damaged);
    }
  }
}

TEST(SeiReader, DamagedPicturesAreReadToWhereTheyAreWhole) {
  const std::vector<Bytes> units{kParameters, unit_of(std::string(300, 'x')), kSlice};
  read_damaged(as_stream(units, false), read_stream);
  read_damaged(as_stream(units, true), read_stream);
  read_damaged(as_counted(units), read_counted);
  for (const Bytes& bytes : {Bytes{}, Bytes{0}, Bytes{0, 0, 1}, Bytes{0, 0, 0, 1}, Bytes(5000, 255),
                             Bytes(5000, 0), Bytes(5000, 78), as_counted({Bytes{78, 1, 255, 255}})}) {
    EXPECT_FALSE(read_stream(bytes));
    EXPECT_FALSE(read_counted(bytes));
  }
}

}  // namespace
}  // namespace geoloc::io
