// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mqtt/mqtt_address.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace geoloc::io {
namespace {

std::string fault_of(const std::string& url) {
  try {
    static_cast<void>(parse_mqtt_address(url));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(MqttAddress, ToldInFullOrInPart) {
  const MqttAddress all = parse_mqtt_address("mqtts://drone-1@[fe80::1]:8884/club");
  EXPECT_TRUE(all.is_tls);
  EXPECT_EQ(all.user, "drone-1");
  EXPECT_EQ(all.host, "fe80::1");
  EXPECT_EQ(all.port, 8884);
  EXPECT_EQ(all.fleet, "club");
  EXPECT_EQ(all.url(), "mqtts://[fe80::1]:8884/club");
  EXPECT_EQ(parse_mqtt_address("mqtt://broker.local/a").port, 1883);
  EXPECT_EQ(parse_mqtt_address("mqtts://broker.local/a").port, 8883);
  EXPECT_EQ(parse_mqtt_address("mqtt://broker.local/a").user, "");
}

TEST(MqttAddress, APasswordIsRefusedWithoutBeingRepeated) {
  const std::string fault = fault_of("mqtt://me:secret@host/club");
  EXPECT_NE(fault.find("--mqtt-password-file"), std::string::npos);
  EXPECT_EQ(fault.find("secret"), std::string::npos);
}

TEST(MqttAddress, WhatIsNoneIsRefused) {
  for (const char* url :
       {"", "host", "http://host/club", "mqtt://", "mqtt://host", "mqtt://host/", "mqtt:///club",
        "mqtt://host:0/club", "mqtt://host:65536/club", "mqtt://host:x/club", "mqtt://host/club/more",
        "mqtt://host/my club", "mqtt://host/#", "mqtt://host/+", "mqtt://@host/club", "mqtt://a b@host/club",
        "mqtt://ho st/club", "mqtt://host/12345678901234567890123456789012345678901234567890123456789012345"})
    EXPECT_NE(fault_of(url), "") << url;
}

TEST(SummaryTopic, IsThatOfItsFleetAndFlight) {
  const std::string topic = summary_topic("club", "2026-11-01T10:00:00_1");
  EXPECT_EQ(topic, "geoloc/v1/club/2026-11-01T10:00:00_1/summary");
  EXPECT_EQ(flight_of_topic(topic, "club"), "2026-11-01T10:00:00_1");
  for (const char* other :
       {"", "geoloc/v1/club//summary", "geoloc/v1/club/summary", "geoloc/v1/club/a/b/summary",
        "geoloc/v1/clubs/a/summary", "geoloc/v2/club/a/summary", "geoloc/v1/club/a/summary/b",
        "geoloc/v1/club/a b/summary", "geoloc/v1/club/+/summary"})
    EXPECT_EQ(flight_of_topic(other, "club"), std::nullopt) << other;
}

}  // namespace
}  // namespace geoloc::io
