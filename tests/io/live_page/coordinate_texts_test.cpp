// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/coordinate_texts.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace geoloc::io {
namespace {

struct Printed {
  Geodetic place;
  const char* utm;
  const char* mgrs;
};

TEST(CoordinateTexts, AreWhatOtherToolsPrint) {
  // PROJ 9 (pyproj 3.7.2: EPSG 32723, 32631, 32632, 5041) and GeoTrans (mgrs 1.5.0 from PyPI).
  const Printed all[] = {{{-22.90612346, -43.13398765}, "23K 691387.53 E 7465658.95 N", "23KPQ9138765658"},
                         {{48.8583701, 2.2944813}, "31U 448250.60 E 5411951.60 N", "31UDQ4825011951"},
                         {{60.5, 5.2}, "32V 291330.10 E 6713123.10 N", "32VKN9133013123"},
                         {{85.0, -30.0}, "Y 1722271.30 E 1518959.79 N", "YXC2227118959"}};
  for (const Printed& printed : all) {
    const CoordinateTexts texts = coordinate_texts(printed.place);
    EXPECT_EQ(texts.utm, printed.utm);
    EXPECT_EQ(texts.mgrs, printed.mgrs);
  }
}

TEST(CoordinateTexts, DegreesAndSexagesimalsAreTheSamePlace) {
  const CoordinateTexts texts = coordinate_texts({-22.5, 43.0 + 8.0 / 60.0 + 2.356 / 3600.0});
  EXPECT_EQ(texts.degrees, "-22.50000000, 43.13398778");
  EXPECT_EQ(texts.dms, "22°30′00.000″S 043°08′02.356″E");
}

TEST(CoordinateTexts, OfNoPlaceAreEmpty) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Geodetic& place : {Geodetic{nan, 0.0}, Geodetic{0.0, nan}, Geodetic{91.0, 0.0}}) {
    EXPECT_TRUE(coordinate_texts(place).degrees.empty());
    EXPECT_TRUE(coordinate_texts(place).mgrs.empty());
  }
}

}  // namespace
}  // namespace geoloc::io
