// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "geoloc/io/output/cot_connection.hpp"
#include "geoloc/io/output/cot_event.hpp"
#include "geoloc/io/output/geoid.hpp"
#include "io/output/cot_fields.hpp"
#include "support/setting_bounds.hpp"
#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

ObjectReport a_car() {
  ObjectReport object;
  object.id = 3;
  object.class_name = "car";
  object.position = {-22.9, -43.1};
  object.ellipse = {1.0, 1.0, 0.0};
  return object;
}

TEST(CotEndpoint, IsUdpTcpOrTls) {
  const CotEndpoint atak = parse_cot_endpoint("udp://239.2.3.1:6969");
  EXPECT_EQ(atak.transport, CotTransport::kUdp);
  EXPECT_EQ(atak.host, "239.2.3.1");
  EXPECT_EQ(atak.port, "6969");
  EXPECT_EQ(parse_cot_endpoint("tcp://[::1]:8087").host, "::1");
  EXPECT_EQ(parse_cot_endpoint("tls://takserver:8089").transport, CotTransport::kTls);
  for (const char* text :
       {"", "udp://", "239.2.3.1:6969", "http://a:1", "udp://a", "udp://a:0", "udp://a:70000", "udp://:1",
        "udp://a b:1", "tcp://a:1x", "tcp://::1:80", "ssl://a:1", "tls://a", "TLS://a:1"}) {
    EXPECT_THROW(parse_cot_endpoint(text), std::invalid_argument) << text;
  }
}

TEST(CotEvent, HasATypeForItsClassAndErrorsOfThatProbability) {
  CotConfig config;
  config.types["car"] = "a-n-G-E-V-C";
  const std::string event = to_cot(a_car(), {"u", HostTime{}, false, 10.0}, config);
  EXPECT_NE(event.find("type=\"a-n-G-E-V-C\""), std::string::npos);
  EXPECT_NE(event.find("ce=\"2.15\""), std::string::npos) << event;  // sqrt(-2 ln 0.1)
  EXPECT_NE(event.find("le=\"3.29\""), std::string::npos) << event;  // 1.645 * 2 m
  EXPECT_NE(event.find("hae=\"10.00\""), std::string::npos) << event;
}

/// What the object's height and sea level are off by are independent.
TEST(CotEvent, IsAsUnsureOfTheHeightAsObjectAndSeaLevelTogether) {
  ObjectReport car = a_car();
  car.height = {12.0, 1.5, 34.5};
  const std::string event = to_cot(car, {"u", HostTime{}, false, 10.0}, {});
  EXPECT_NE(event.find("le=\"4.11\""), std::string::npos) << event;  // 1.645 * hypot(2, 1.5)
  EXPECT_NE(event.find("34.5 m above mean sea level"), std::string::npos) << event;
}

TEST(CotEvent, OfAnObjectThatIsGoneIsOutOfDateAtOnce) {
  const std::string event = to_cot(a_car(), {"u", HostTime{}, true, {}}, {});
  EXPECT_NE(event.find("stale=\"1970-01-01T00:00:00.000Z\""), std::string::npos);
  EXPECT_NE(event.find("hae=\"9999999.00\""), std::string::npos);
  EXPECT_NE(event.find("<remarks>retracted, confidence"), std::string::npos) << event;
  EXPECT_EQ(to_cot(a_car(), {"u", HostTime{}, false, {}}, {}).find("retracted"), std::string::npos);
}

TEST(CotConfig, NamesItsFaults) {
  CotConfig config;
  EXPECT_TRUE(config.problems().empty());
  config.type = "a-u-G\"/>";
  config.types["x"] = "-";
  config.uid_prefix = "a b";
  config.stale_s = 1.0;
  config.error_probability = std::nan("");
  config.multicast_ttl = 256;
  EXPECT_EQ(config.problems().size(), 6U);
}

TEST(CotConfig, KeepsEveryBoundThatItsDescriptionNames) {
  EXPECT_GT(testing::expect_bounds_are_kept<CotConfig>(), 0U);
}

/// A world on which the sea stands 30 m above the ellipsoid everywhere, in GeographicLib's format.
void write_flat_geoid(const std::filesystem::path& folder) {
  std::ofstream file(folder / "egm96-5.pgm", std::ios::binary);
  file << "P5\n# Offset -108\n# Scale 0.003\n# Origin 90N 0E\n4 3\n65535\n";
  const auto sample = static_cast<std::uint16_t>((30.0 + 108.0) / 0.003);
  for (int i = 0; i < 4 * 3; ++i) file << static_cast<char>(sample >> 8) << static_cast<char>(sample & 0xFF);
}

TEST(Geoid, LiftsTheSeaOntoTheEllipsoid) {
  const testing::TemporaryFolder folder;
  EXPECT_FALSE(Geoid(folder.path().string()).is_installed());
  EXPECT_EQ(Geoid(folder.path().string()).height_ellipsoid_m({-22.9, -43.1}, 700.0), std::nullopt);
  write_flat_geoid(folder.path());
  const Geoid geoid(folder.path().string());
  ASSERT_TRUE(geoid.is_installed());
  EXPECT_NEAR(*geoid.height_ellipsoid_m({-22.9, -43.1}, 700.0), 730.0, 0.01);
  EXPECT_EQ(geoid.height_ellipsoid_m({std::nan(""), 0.0}, 700.0), std::nullopt);
  EXPECT_EQ(geoid.height_ellipsoid_m({0.0, 0.0}, std::nan("")), std::nullopt);
}

}  // namespace
}  // namespace geoloc::io
