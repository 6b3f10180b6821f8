// SPDX-License-Identifier: Apache-2.0
#include "page_access.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>

#include <cstring>

#include "client_address.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

const std::string kToken = "0123456789abcdef";
constexpr TokenGuesses::Time kNow{};

PageRequest request_for(const std::string& path) {
  PageRequest request;
  request.method = "GET";
  request.path = path;
  request.host = "192.168.4.1:8080";
  request.client_network = "192.168.4.7";
  return request;
}

PageRequest by_link(const std::string& token) {
  PageRequest request = request_for("/");
  request.query = "token=" + token;
  return request;
}

PageRequest by_cookie(const std::string& token) {
  PageRequest request = request_for("/events");
  request.cookie = "theme=dark; geoloc_8080=" + token + "; other=1";
  return request;
}

PageRequest by_header(const std::string& token) {
  PageRequest request = request_for("/objects/1");
  request.authorization = "Bearer " + token;
  return request;
}

/// 200 where the page itself answers.
int status_of(const PageAccess& access, const PageRequest& request, TokenGuesses::Time now = kNow) {
  const auto instead = access.answer_instead(request, now);
  return instead ? instead->status : 200;
}

std::string header_of(const PageAnswer& answer, const std::string& wanted) {
  for (const auto& [name, value] : answer.headers) {
    if (name == wanted) return value;
  }
  return "";
}

TEST(PageAccess, WithoutATokenEverybodyMayLook) {
  EXPECT_EQ(status_of(PageAccess(""), request_for("/")), 200);
  EXPECT_EQ(status_of(PageAccess(""), by_link("anything")), 200);
}

TEST(PageAccess, WithoutTheTokenNothingIsShown) {
  const PageAccess access(kToken);
  for (const char* const path :
       {"/", "/page.js", "/events", "/frame", "/settings", "/objects/1", "/nowhere"}) {
    const auto answer = access.answer_instead(request_for(path), kNow);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->status, 401) << path;
    EXPECT_EQ(header_of(*answer, "WWW-Authenticate").rfind("Bearer", 0), 0U);
    EXPECT_EQ(answer->body.find(kToken), std::string::npos);
  }
}

TEST(PageAccess, TheTokenOpensByCookieAndByHeader) {
  const PageAccess access(kToken);
  EXPECT_EQ(status_of(access, by_cookie(kToken)), 200);
  EXPECT_EQ(status_of(access, by_header(kToken)), 200);
  PageRequest lower_case = request_for("/events");
  lower_case.authorization = "bearer " + kToken;
  EXPECT_EQ(status_of(access, lower_case), 200);
}

TEST(PageAccess, ALinkSetsTheCookieAndLeadsToTheCleanAddress) {
  const PageAccess access(kToken);
  const auto answer = access.answer_instead(by_link(kToken), kNow);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(header_of(*answer, "Set-Cookie"),
            "geoloc_8080=" + kToken + "; Path=/; Max-Age=2592000; HttpOnly; SameSite=Strict");
  EXPECT_NE(answer->body.find("<meta http-equiv=\"refresh\" content=\"0; url=/\">"), std::string::npos);
  EXPECT_EQ(answer->body.find(kToken), std::string::npos);
  PageRequest over_tls = by_link(kToken);
  over_tls.is_over_tls = true;
  EXPECT_NE(header_of(*access.answer_instead(over_tls, kNow), "Set-Cookie").find("; Secure"),
            std::string::npos);
}

TEST(PageAccess, ALinkOpensTheFrontPageAlone) {
  PageRequest request = by_link(kToken);
  request.path = "/events";
  EXPECT_EQ(status_of(PageAccess(kToken), request), 401);
}

TEST(PageAccess, NearlyTheTokenIsWrong) {
  for (const std::string& wrong :
       {std::string(), kToken.substr(1), kToken + "0", "1" + kToken.substr(1), kToken.substr(0, 15) + "e",
        " " + kToken, std::string("0123456789ABCDEF"), kToken + std::string(1, '\0')}) {
    const PageAccess access(kToken);
    EXPECT_EQ(status_of(access, by_link(wrong)), 401) << wrong;
    EXPECT_EQ(status_of(access, by_cookie(wrong)), 401) << wrong;
    EXPECT_EQ(status_of(access, by_header(wrong)), 401) << wrong;
    EXPECT_FALSE(is_same_secret(wrong, kToken)) << wrong;
  }
  EXPECT_TRUE(is_same_secret(kToken, kToken));
}

TEST(PageAccess, TheCookieOfAnotherPortIsNotOurs) {
  PageRequest request = by_cookie(kToken);
  request.host = "192.168.4.1:8081";
  EXPECT_FALSE(offered_token(request));
  EXPECT_EQ(status_of(PageAccess(kToken), request), 401);
}

TEST(PageAccess, GuessingIsSlow) {
  const PageAccess access(kToken);
  for (int i = 0; i < TokenGuesses::kMostWrong; ++i)
    EXPECT_EQ(status_of(access, by_header("wrong" + std::to_string(i))), 401);
  EXPECT_EQ(status_of(access, by_header("wrong again")), 429);
  EXPECT_EQ(status_of(access, by_header(kToken)), 429);  // otherwise guessing would go on unhindered
  EXPECT_EQ(status_of(access, request_for("/")), 401);
  PageRequest neighbour = by_header(kToken);
  neighbour.client_network = "192.168.4.8";
  EXPECT_EQ(status_of(access, neighbour), 200);
  EXPECT_EQ(status_of(access, by_header(kToken), kNow + TokenGuesses::kPeriod), 200);
}

TEST(PageAccess, ABrowserWithAnOldCookieIsNotGuessing) {
  const PageAccess access(kToken);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(status_of(access, by_cookie("of an earlier run")), 401);
  EXPECT_EQ(status_of(access, by_link(kToken)), 200);
}

TEST(TokenGuesses, AreRememberedForABoundedNumberOfNetworks) {
  TokenGuesses guesses;
  const auto note = [&guesses](const std::string& network) {
    for (int i = 0; i < TokenGuesses::kMostWrong; ++i) guesses.note_wrong(network, std::to_string(i), kNow);
  };
  note("first");
  EXPECT_FALSE(guesses.may_try("first", kNow));
  for (std::size_t i = 0; i < TokenGuesses::kMostNetworks; ++i) note(std::to_string(i));
  EXPECT_TRUE(guesses.may_try("first", kNow));
  EXPECT_FALSE(guesses.may_try("1", kNow));
}

TEST(MayChange, ThisComputerWhereThereIsNoToken) {
  const PageAccess access("");
  PageRequest request = request_for("/objects/1");
  EXPECT_FALSE(access.may_change(request));
  request.is_from_this_computer = true;
  EXPECT_TRUE(access.may_change(request));
  request.is_forwarded = true;  // a proxy of this computer speaks for whomever
  EXPECT_FALSE(access.may_change(request));
}

TEST(MayChange, WhoeverHasTheTokenWhereThereIsOne) {
  const PageAccess access(kToken);
  EXPECT_TRUE(access.may_change(by_cookie(kToken)));
  EXPECT_TRUE(access.may_change(by_header(kToken)));
  PageRequest wrong = by_cookie("0123456789abcdee");
  wrong.is_from_this_computer = true;
  EXPECT_FALSE(access.may_change(wrong));
  PageRequest without = request_for("/objects/1");
  without.is_from_this_computer = true;
  EXPECT_FALSE(access.may_change(without));
}

TEST(MayChange, NotThroughAPageOfAnotherSite) {
  const PageAccess access(kToken);
  PageRequest request = by_cookie(kToken);
  for (const char* const origin :
       {"null", "http://evil.example", "http://192.168.4.1", "http://192.168.4.1:8081",
        "http://192.168.4.1:8080.evil.example", "https://evil.example/http://192.168.4.1:8080"}) {
    request.origin = origin;
    EXPECT_FALSE(access.may_change(request)) << origin;
  }
  for (const char* const origin : {"", "http://192.168.4.1:8080", "https://192.168.4.1:8080"}) {
    request.origin = origin;
    EXPECT_TRUE(access.may_change(request)) << origin;
  }
  for (const char* const site : {"cross-site", "same-site", "none"}) {
    request.fetch_site = site;
    EXPECT_FALSE(access.may_change(request)) << site;
  }
  request.fetch_site = "same-origin";
  EXPECT_TRUE(access.may_change(request));
}

ClientAddress of(const std::string& text) {
  sockaddr_storage address{};
  in_addr v4{};
  if (inet_pton(AF_INET, text.c_str(), &v4) == 1) {
    reinterpret_cast<sockaddr_in&>(address).sin_addr = v4;
    address.ss_family = AF_INET;
  } else if (inet_pton(AF_INET6, text.c_str(), &reinterpret_cast<sockaddr_in6&>(address).sin6_addr) == 1) {
    address.ss_family = AF_INET6;
  }
  return client_address(address);
}

TEST(ClientAddress, IsThisComputersWhereItIsOfTheLoopback) {
  for (const char* const text : {"127.0.0.1", "127.8.9.1", "::1", "::ffff:127.0.0.1"})
    EXPECT_TRUE(of(text).is_this_computer) << text;
  for (const char* const text : {"192.168.4.7", "128.0.0.1", "::2", "fe80::1", "::ffff:10.0.0.1", "nonsense"})
    EXPECT_FALSE(of(text).is_this_computer) << text;
}

TEST(ClientAddress, IsOneForAllAddressesThatOneComputerCanHave) {
  EXPECT_EQ(of("2001:db8:1:2:3:4:5:6").network, of("2001:db8:1:2:ffff::").network);
  EXPECT_NE(of("2001:db8:1:2::").network, of("2001:db8:1:3::").network);
  EXPECT_EQ(of("::ffff:10.0.0.1").network, "10.0.0.1");
  EXPECT_NE(of("10.0.0.1").network, of("10.0.0.2").network);
}

TEST(ClientAddress, OfAProxysClientIsWhatAProxyOfThisComputerStates) {
  EXPECT_EQ(behind_proxy(of("127.0.0.1"), "192.168.4.7").network, "192.168.4.7");
  EXPECT_EQ(behind_proxy(of("::1"), "2001:db8::1").network, of("2001:db8::2").network);
  for (const char* const nonsense : {"", "somebody", "192.168.4.7:80", "192.168.4.7\n"})
    EXPECT_EQ(behind_proxy(of("127.0.0.1"), nonsense).network, "127.0.0.1") << nonsense;
  EXPECT_EQ(behind_proxy(of("192.168.4.9"), "192.168.4.7").network, "192.168.4.9");
}

}  // namespace
}  // namespace geoloc::io
