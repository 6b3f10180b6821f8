// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "geoloc/io/output/cot_connection.hpp"
#include "geoloc/io/output/cot_event.hpp"
#include "io/output/cot_fields.hpp"
#include "support/setting_bounds.hpp"

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
  ObjectReport car = a_car();
  car.height.ellipsoid_m = 10.0;
  const std::string event = to_cot(car, {"u", HostTime{}, false}, config);
  EXPECT_NE(event.find("type=\"a-n-G-E-V-C\""), std::string::npos);
  EXPECT_NE(event.find("ce=\"2.15\""), std::string::npos) << event;  // sqrt(-2 ln 0.1)
  EXPECT_NE(event.find("le=\"3.29\""), std::string::npos) << event;  // 1.645 * 2 m
  EXPECT_NE(event.find("hae=\"10.00\""), std::string::npos) << event;
}

/// What the object's height and sea level are off by are independent.
TEST(CotEvent, IsAsUnsureOfTheHeightAsObjectAndSeaLevelTogether) {
  ObjectReport car = a_car();
  car.height = {12.0, 1.5, 34.5, 44.5};
  const std::string event = to_cot(car, {"u", HostTime{}, false}, {});
  EXPECT_NE(event.find("le=\"4.11\""), std::string::npos) << event;  // 1.645 * hypot(2, 1.5)
  EXPECT_NE(event.find("34.5 m above mean sea level"), std::string::npos) << event;
}

TEST(CotEvent, OfAnObjectThatIsGoneIsOutOfDateAtOnce) {
  const std::string event = to_cot(a_car(), {"u", HostTime{}, true}, {});
  EXPECT_NE(event.find("stale=\"1970-01-01T00:00:00.000Z\""), std::string::npos);
  EXPECT_NE(event.find("hae=\"9999999.00\""), std::string::npos);
  EXPECT_NE(event.find("<remarks>retracted, confidence"), std::string::npos) << event;
  EXPECT_EQ(to_cot(a_car(), {"u", HostTime{}, false}, {}).find("retracted"), std::string::npos);
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

}  // namespace
}  // namespace geoloc::io
