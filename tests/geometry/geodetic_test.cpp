// SPDX-License-Identifier: Apache-2.0
#include "geoloc/geometry/geodetic.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace geoloc {
namespace {

// Printed by GeographicLib 2.1's own program:
//   echo LAT LON H | CartConvert -l LAT0 LON0 H -p 6
struct LocalCase {
  Geodetic origin;
  double height_m;
  Geodetic point;
  double east_m, north_m;
};
constexpr LocalCase kLocalCases[] = {
    {{-22.906, -43.133}, 10.0, {-22.9, -43.12}, 1333.774810, 664.398086},
    {{48.0, 16.0}, 200.0, {48.2, 16.37}, 27505.160223, 22305.105578},
    {{70.0, -179.99}, 0.0, {70.01, 179.99}, -763.364858, 1115.746075},
};

TEST(LocalFrame, AgreesWithCartConvert) {
  for (const LocalCase& c : kLocalCases) {
    const LocalPoint local = LocalFrame(c.origin, c.height_m).to_local(c.point);
    EXPECT_NEAR(local.position_in_enu.x(), c.east_m, 2e-6);
    EXPECT_NEAR(local.position_in_enu.y(), c.north_m, 2e-6);
  }
}

TEST(LocalFrame, GoesThereAndBack) {
  const LocalFrame frame({-22.906, -43.133}, 10.0);
  for (const double distance_m : {0.0, 1.0, 100.0, 5e3, 50e3}) {
    const Eigen::Vector2d local{distance_m, -0.3 * distance_m};
    EXPECT_LT((frame.to_local(frame.to_geodetic(local)).position_in_enu - local).norm(), 1e-5) << distance_m;
  }
}

TEST(LocalFrame, RefusesAnOriginThatIsNoPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(LocalFrame({91.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(LocalFrame({nan, 0.0}), std::invalid_argument);
  EXPECT_THROW(LocalFrame({0.0, 0.0}, nan), std::invalid_argument);
}

TEST(Utm, AgreesWithGeoConvert) {
  // echo LAT LON | GeoConvert -u -p 6
  struct Case {
    Geodetic point;
    UtmPoint expected;
  };
  const Case cases[] = {{{-22.906, -43.133}, {23, false, 691489.024693, 7465671.339567}},
                        {{48.2, 16.37}, {33, true, 601799.145791, 5339437.153786}},
                        {{61.5, 5.3}, {32, true, 303110.199030, 6824071.422293}},   // Norway's exception
                        {{78.2, 15.6}, {33, true, 513696.945417, 8680760.053196}},  // Svalbard's
                        {{85.5, 20.0}, {0, true, 2170960.055813, 1530291.107024}},  // UPS
                        {{-89.0, -120.0}, {0, false, 1903848.213083, 1944486.739940}}};
  for (const Case& c : cases) {
    const auto utm = to_utm(c.point);
    ASSERT_TRUE(utm);
    EXPECT_EQ(utm->zone, c.expected.zone);
    EXPECT_EQ(utm->north, c.expected.north);
    EXPECT_NEAR(utm->easting_m, c.expected.easting_m, 2e-6);
    EXPECT_NEAR(utm->northing_m, c.expected.northing_m, 2e-6);
  }
  EXPECT_FALSE(to_utm({std::numeric_limits<double>::quiet_NaN(), 0.0}));
}

}  // namespace
}  // namespace geoloc
