// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mqtt/summary_inbox.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "fleet/synthetic_fleet.hpp"
#include "fuzz/hostile_messages.hpp"
#include "geoloc/io/fleet/summary_file.hpp"
#include "geoloc/io/mqtt/mqtt_address.hpp"
#include "support/spoilt_bytes.hpp"

namespace geoloc::io {
namespace {

FlightSummary any_flight(const std::string& name, std::uint64_t sequence = 1) {
  std::mt19937 random(5);
  FlightSummary summary = testing::draw_flight(name, testing::clustered_targets(7, random), {}, random);
  summary.identity.sequence = sequence;
  return summary;
}

std::string topic_of(const std::string& flight) {
  return summary_topic("club", flight);
}

TEST(SummaryInbox, TakesWhatIsNewerInWhateverOrderAndHoweverOften) {
  SummaryInbox inbox("club");
  const std::string first = summary_to_bytes(any_flight("a", 1)),
                    second = summary_to_bytes(any_flight("a", 2));
  EXPECT_TRUE(inbox.open(topic_of("a"), second));
  EXPECT_FALSE(inbox.open(topic_of("a"), first));
  EXPECT_FALSE(inbox.open(topic_of("a"), second));
  EXPECT_TRUE(inbox.open(topic_of("b"), summary_to_bytes(any_flight("b"))));
  EXPECT_EQ(inbox.counts().taken, 2U);
  EXPECT_EQ(inbox.counts().repeated, 2U);
  EXPECT_EQ(inbox.counts().refused, 0U);
}

TEST(SummaryInbox, ASummaryOfAnotherFlightThanItsTopicIsRefused) {
  SummaryInbox inbox("club");
  EXPECT_FALSE(inbox.open(topic_of("a"), summary_to_bytes(any_flight("b", 99))));
  EXPECT_EQ(inbox.counts().refused, 1U);
  EXPECT_NE(inbox.last_refusal().find("is of another flight, b"), std::string::npos);
  EXPECT_TRUE(inbox.open(topic_of("b"), summary_to_bytes(any_flight("b", 1))));
}

TEST(SummaryInbox, ClaimsThatCannotBeAreRefused) {
  const auto refusal_of = [](FlightSummary summary) {
    SummaryInbox inbox("club");
    EXPECT_FALSE(inbox.open(topic_of("a"), summary_to_bytes(summary)));
    return inbox.last_refusal();
  };
  FlightSummary flight = any_flight("a");
  flight.objects[2].own_covariance(0, 0) = -1.0;
  EXPECT_NE(refusal_of(flight).find("positive definite"), std::string::npos);
  flight = any_flight("a");
  flight.objects[2].position_in_enu.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal_of(flight).find("within 100 km"), std::string::npos);
  flight = any_flight("a");
  flight.shared_error(0, 0) = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal_of(flight).find("shared errors"), std::string::npos);
}

TEST(SummaryInbox, JsonIsForFilesAndNotForMessages) {
  SummaryInbox inbox("club");
  EXPECT_FALSE(inbox.open(topic_of("a"), summary_to_json(any_flight("a"))));
  EXPECT_EQ(inbox.counts().refused, 1U);
}

TEST(SummaryInbox, WhatItTakesIsBounded) {
  const std::string bytes = summary_to_bytes(any_flight("a"));
  SummaryInbox small("club", {bytes.size() - 1, 1U << 20, 10});
  EXPECT_FALSE(small.open(topic_of("a"), bytes));
  SummaryInbox few("club", {1U << 20, 1U << 20, 2});
  for (const char* name : {"a", "b", "c"}) few.open(topic_of(name), summary_to_bytes(any_flight(name)));
  EXPECT_EQ(few.counts().taken, 2U);
  EXPECT_TRUE(few.open(topic_of("b"), summary_to_bytes(any_flight("b", 2))))
      << "of the flights that are there";
  SummaryInbox light("club", {1U << 20, 2 * bytes.size(), 10});
  for (const char* name : {"a", "b", "c"}) light.open(topic_of(name), summary_to_bytes(any_flight(name)));
  EXPECT_EQ(light.counts().taken, 2U);
}

TEST(SummaryInbox, AnEmptyMessageForgetsNothing) {
  SummaryInbox inbox("club");
  EXPECT_FALSE(inbox.open(topic_of("a"), ""));
  EXPECT_EQ(inbox.counts().refused, 0U);
}

TEST(SummaryInbox, SpoiltMessagesAndStatesDoNoHarm) {
  const std::string message = topic_of("a") + "\n" + summary_to_bytes(any_flight("a"));
  const std::string address = "mqtts://me@[::1]:8883/club";
  const std::string ids = ids_to_json({{{"a", {{1, 7}, {2, 3}}}, {"b", {{18446744073709551615U, 7}}}}, 9});
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    hostile::open_any_message(testing::spoilt(message, random));
    hostile::read_any_address(testing::spoilt(address, random));
    hostile::read_any_ids(testing::spoilt(ids, random));
  }
}

}  // namespace
}  // namespace geoloc::io
