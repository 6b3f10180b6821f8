// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>

#include "geoloc/io/stills/still.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

// `date --utc --date=2016-06-23T16:32:43Z +%s`
constexpr Duration kMoment = std::chrono::seconds{1466699563};

CaptureTime time_of(const std::map<std::string, std::string>& exif,
                    const std::map<std::string, std::string>& xmp = {}) {
  return capture_time_of({4000, 3000, exif, xmp}).value();
}

TEST(CaptureTime, HasTheFractionAndTheZoneThatEXIFTells) {
  const CaptureTime time = time_of({{"DateTimeOriginal", "2016:06:23 16:32:43"},
                                    {"SubSecTimeOriginal", "125"},
                                    {"OffsetTimeOriginal", "-03:30"}});
  EXPECT_EQ(time.local, kMoment + 125ms);
  EXPECT_TRUE(time.has_fraction);
  EXPECT_EQ(time.utc_offset, Duration{-3h - 30min});
}

TEST(CaptureTime, WithoutAFractionOrAZoneSaysSo) {
  const CaptureTime time = time_of({{"DateTimeOriginal", "2016:06:23 16:32:43"}});
  EXPECT_EQ(time.local, kMoment);
  EXPECT_FALSE(time.has_fraction);
  EXPECT_FALSE(time.utc_offset);
}

TEST(CaptureTime, ZoneIsWhatTheCameraIsAheadOfGnssToQuartersOfAnHour) {
  const auto zone = [](const char* gnss) {
    return time_of({{"DateTimeOriginal", "2016:06:23 16:32:43"},
                    {"GPSDateStamp", "2016:06:23"},
                    {"GPSTimeStamp", gnss}})
        .utc_offset;
  };
  EXPECT_EQ(zone("(11) (2) (44.5)"), Duration{5h + 30min});
  EXPECT_EQ(zone("(21) (32) (41)"), Duration{-5h});
  EXPECT_FALSE(zone("(11) (9) (44)"));  // a clock that is minutes off tells no zone
}

TEST(CaptureTime, OfSurveyCamerasIsUTCAtTheExposure) {
  const CaptureTime time = time_of({{"DateTimeOriginal", "2016:06:24 00:00:00"}},
                                   {{"drone-dji:UTCAtExposure", "2016-06-23T16:32:43.250001"}});
  EXPECT_EQ(time.local, kMoment + 250'001us);
  EXPECT_EQ(time.utc_offset, Duration{});
}

TEST(CaptureTime, OfXMPIsTakenWhereEXIFHasNone) {
  const CaptureTime time = time_of({}, {{"xmp:CreateDate", "2016-06-23T16:32:43.5+02:00"}});
  EXPECT_EQ(time.local, kMoment + 500ms);
  EXPECT_EQ(time.utc_offset, Duration{2h});
}

TEST(CaptureTime, OfNonsenseIsNone) {
  for (const char* text : {"", "0000:00:00 00:00:00", "2016:13:23 16:32:43", "yesterday", "2016:06:23"})
    EXPECT_FALSE(capture_time_of({1, 1, {{"DateTimeOriginal", text}}, {}})) << text;
}

}  // namespace
}  // namespace geoloc::io
