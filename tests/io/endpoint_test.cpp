// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/endpoint.hpp"

#include <gtest/gtest.h>

namespace geoloc::io {
namespace {

TEST(Endpoint, IsAHostAndAPort) {
  for (const char* const host : {"127.0.0.1", "ground-station.local", "A1"}) {
    const auto endpoint = parse_endpoint(std::string(host) + ":14550");
    ASSERT_TRUE(endpoint) << host;
    EXPECT_EQ(endpoint->host, host);
    EXPECT_EQ(endpoint->port, 14550);
  }
  EXPECT_EQ(parse_endpoint("[fe80::1%eth0]:0")->host, "fe80::1%eth0");
  EXPECT_EQ(parse_endpoint("[::1]:65535")->port, 65535);
}

TEST(Endpoint, OfThisComputerIsItsNameOrItsLoopbackAddress) {
  for (const char* const host : {"localhost", "::1", "127.0.0.1", "127.1.2.3"})
    EXPECT_TRUE(is_loopback(host)) << host;
  for (const char* const host : {"", "0.0.0.0", "::", "128.0.0.1", "localhost.example", "10.127.0.1"})
    EXPECT_FALSE(is_loopback(host)) << host;
}

TEST(Endpoint, IsAPortAloneOnlyWhereItsHostIsKnown) {
  EXPECT_EQ(parse_endpoint("80", "here")->host, "here");
  EXPECT_EQ(parse_endpoint("there:80", "here")->host, "there");
  EXPECT_FALSE(parse_endpoint("80"));
}

TEST(Endpoint, HasAPortOfDigitsUpTo65535) {
  for (const char* const port :
       {"", "1 ", " 1", "+1", "-1", "65536", "0x10", "1x", "1:", "99999999999999999999"})
    EXPECT_FALSE(parse_endpoint(std::string("a:") + port)) << port;
}

TEST(Endpoint, HasAHostOfANamesCharactersOrABracketedAddress) {
  for (const char* const host : {"", "a b", "a/b", "a;b", "a\n", "a%b", "a_b", "::1", "[]", "[::1", "::1]",
                                 "[a b]", "[[::1]]", "udp://a", "a:1", "\xc3\xa4"})
    EXPECT_FALSE(parse_endpoint(std::string(host) + ":1")) << host;
}

TEST(Endpoint, IsNotAHostAlone) {
  for (const char* const text : {"", "a", "127.0.0.1", "[::1]", "::1"})
    EXPECT_FALSE(parse_endpoint(text, "here")) << text;
}

}  // namespace
}  // namespace geoloc::io
