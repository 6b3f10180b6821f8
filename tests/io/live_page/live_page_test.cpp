// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <future>
#include <optional>
#include <stdexcept>

#include "loopback_client.hpp"
#include "page_frames.hpp"

namespace geoloc::io {
namespace {

using testing::ask;
using testing::get_request;
using testing::kPatience;
using testing::LoopbackClient;
using testing::page_frame;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::string status_of(const std::string& answer) {
  return answer.substr(0, answer.find("\r\n"));
}

/// A page on a free port, with as short a timeout as a test needs.
class Page : public ::testing::Test {
 protected:
  void open(const LivePageConfig& config = {}) {
    page.emplace(HttpEndpoint{"127.0.0.1", 0}, config, LivePageTitle{"run", true},
                 std::vector<std::string>{});
    const std::string url = page->url();
    port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
  }

  std::optional<LivePage> page;
  std::uint16_t port = 0;
};

TEST_F(Page, IsServedWithItsRulesForBrowsers) {
  open();
  const std::string answer = ask(port, get_request("/"));
  EXPECT_EQ(status_of(answer), "HTTP/1.1 200 OK");
  EXPECT_NE(answer.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
  EXPECT_NE(answer.find("Connection: close"), std::string::npos);
  EXPECT_NE(answer.find("<!DOCTYPE html>"), std::string::npos);
}

TEST_F(Page, StreamsWhatChangesAsItChanges) {
  open();
  const LoopbackClient client(port);
  client.send(get_request("/events"));
  const std::string first = client.read_until("\n\n", kPatience);
  EXPECT_NE(first.find("Content-Type: text/event-stream"), std::string::npos);
  EXPECT_NE(first.find("data: {\"revision\""), std::string::npos);
  page->add(page_frame(1, 2));
  EXPECT_NE(client.read_until("\"id\":2", kPatience).find("\"id\":1"), std::string::npos);
}

TEST_F(Page, KeepsAStreamAliveWhileNothingHappens) {
  open();
  const LoopbackClient client(port);
  client.send(get_request("/events"));
  EXPECT_NE(client.read_until("event: alive", kPatience).find("event: alive"), std::string::npos);
}

TEST_F(Page, HostileRequestsAreRefused) {
  open();
  const std::string long_line(9000, 'a');
  const std::string many_headers = [] {
    std::string text = "GET / HTTP/1.1\r\n";
    for (int i = 0; i < 5000; ++i) text += "X-" + std::to_string(i) + ": y\r\n";
    return text + "\r\n";
  }();
  const struct {
    std::string request, refusal;
  } all[] = {
      {get_request("/", "evil.example"), "421"},
      {"GET / HTTP/1.1\r\n\r\n", "421"},
      {get_request("/../../../../etc/passwd"), "404"},
      {get_request("/%2e%2e/%2e%2e/etc/passwd"), "404"},
      {get_request("/" + long_line), "414"},
      {"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999\r\n\r\n", "405"},
      {"BREW / HTTP/1.1\r\nHost: localhost\r\n\r\n", "400"},
      {"GET / HTTP/9.9\r\nHost: localhost\r\n\r\n", "400"},
      {std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\r\n\r\n", 13), "400"},
      {many_headers, "400"},
      {"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + long_line + "\r\n\r\n", "400"},
  };
  for (const auto& [request, refusal] : all) {
    const std::string status = status_of(ask(port, request));
    EXPECT_EQ(status.rfind("HTTP/1.1 " + refusal, 0), 0U) << request.substr(0, 60) << ": " << status;
  }
  EXPECT_EQ(status_of(ask(port, get_request("/"))), "HTTP/1.1 200 OK");
}

TEST_F(Page, WithATokenIsForThoseWhoHaveIt) {
  const std::string token = "0123456789abcdef";
  page.emplace(HttpEndpoint{"127.0.0.1", 0}, LivePageConfig{}, LivePageTitle{"run", true},
               std::vector<std::string>{}, LivePageParts{token});
  const std::string url = page->url();
  const std::string host = url.substr(7, url.size() - 8);
  port = static_cast<std::uint16_t>(std::stoi(host.substr(host.find(':') + 1)));
  const auto request = [&host](const std::string& path, const std::string& header) {
    return "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n" + header + "\r\n";
  };
  for (const char* const path : {"/", "/events", "/frame", "/page.js"}) {
    EXPECT_EQ(status_of(ask(port, request(path, ""))), "HTTP/1.1 401 Unauthorized") << path;
    EXPECT_EQ(status_of(ask(port, request(path, "Authorization: Bearer 0123456789abcdee\r\n"))),
              "HTTP/1.1 401 Unauthorized");
  }
  const std::string welcome = ask(port, request("/?token=" + token, ""));
  const std::size_t begin = welcome.find("Set-Cookie: ") + 12;
  const std::string cookie = welcome.substr(begin, welcome.find(';', begin) - begin);
  EXPECT_EQ(status_of(ask(port, request("/page.js", "Cookie: " + cookie + "\r\n"))), "HTTP/1.1 200 OK");
  for (int i = 0; i < 20; ++i)
    ask(port, request("/", "Authorization: Bearer wrong" + std::to_string(i) + "\r\n"));
  EXPECT_EQ(status_of(ask(port, request("/", "Cookie: " + cookie + "\r\n"))),
            "HTTP/1.1 429 Too Many Requests");
}

TEST_F(Page, ASmallRequestGetsNoLargeAnswer) {
  open();
  std::string ranges = "Range: bytes=0-";
  for (int i = 0; i < 1000; ++i) ranges += ",0-";
  const std::string plain = ask(port, get_request("/page.js"));
  const std::string answer = ask(port, "GET /page.js HTTP/1.1\r\nHost: localhost\r\n" + ranges + "\r\n\r\n");
  EXPECT_LE(answer.size(), plain.size() + 100);
}

TEST_F(Page, FiftyPagesAllGetTheNews) {
  open();
  std::deque<LoopbackClient> clients;
  for (int i = 0; i < 50; ++i) clients.emplace_back(port).send(get_request("/events"));
  page->add(page_frame(7, 3));
  for (const LoopbackClient& client : clients)
    EXPECT_NE(client.read_until("\"id\":3", kPatience).find("\"id\":3"), std::string::npos);
}

TEST_F(Page, OneMoreThanAllowedIsToldSo) {
  LivePageConfig config;
  config.max_pages = 2;
  open(config);
  std::deque<LoopbackClient> clients;
  for (int i = 0; i < 2; ++i) {
    clients.emplace_back(port).send(get_request("/events"));
    clients.back().read_until("\n\n", kPatience);
  }
  EXPECT_EQ(status_of(ask(port, get_request("/events"))), "HTTP/1.1 503 Service Unavailable");
  clients.clear();
  const auto begin = Clock::now();
  while (seconds_since(begin) < 20.0) {  // the places of clients that left become free again
    const LoopbackClient client(port);
    client.send(get_request("/events"));
    if (client.read_until("\n\n", kPatience).find("200 OK") != std::string::npos) return;
  }
  FAIL() << "no place became free";
}

TEST_F(Page, APageThatDoesNotReadIsDroppedAndHoldsNobodyUp) {
  LivePageConfig config;
  config.write_timeout_s = 0.3;
  config.update_period_s = 0.02;
  open(config);
  const LoopbackClient blocked(port, 4096), healthy(port);
  blocked.send(get_request("/events"));
  healthy.send(get_request("/events"));
  double longest_add_s = 0.0;
  const auto begin = Clock::now();
  for (int number = 0; seconds_since(begin) < 1.5; ++number) {
    OutputFrame frame = page_frame(number, 1000);
    for (ObjectReport& object : frame.objects) object.position_in_enu.y() = number;
    const auto before = Clock::now();
    page->add(frame);
    longest_add_s = std::max(longest_add_s, seconds_since(before));
    healthy.read_until("\n\n", 50ms);
  }
  EXPECT_LT(longest_add_s, 0.3);
  EXPECT_TRUE(blocked.is_ended(kPatience));
  EXPECT_NE(healthy.read_until("\n\n", kPatience), "");
}

TEST_F(Page, ClientsThatSendNothingOrDribbleDoNotDelayTheEnd) {
  open();
  std::deque<LoopbackClient> clients;
  for (int i = 0; i < 40; ++i) clients.emplace_back(port).send(i % 2 == 0 ? "" : "GET / HT");
  for (int i = 0; i < 20; ++i) clients.emplace_back(port).send(get_request("/events"));
  clients.back().read_until("\n\n", kPatience);
  const auto begin = Clock::now();
  page.reset();
  EXPECT_LT(seconds_since(begin), 1.0);
  for (const LoopbackClient& client : clients) EXPECT_TRUE(client.is_ended(kPatience));
}

TEST_F(Page, MoreConnectionsThanThereAreThreadsAreTurnedAway) {
  LivePageConfig config;
  config.max_pages = 1;
  open(config);
  std::deque<LoopbackClient> silent;
  for (int i = 0; i < 60; ++i) silent.emplace_back(port);
  const auto ended = std::count_if(silent.begin(), silent.end(),
                                   [](const LoopbackClient& client) { return client.is_ended(100ms); });
  EXPECT_GE(ended, 20);
}

TEST_F(Page, APortThatIsTakenIsRefusedByName) {
  open();
  try {
    const LivePage second({"127.0.0.1", port}, {}, {"", true}, {});
    FAIL() << "two pages on one port";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("127.0.0.1:" + std::to_string(port)), std::string::npos)
        << error.what();
  }
}

TEST_F(Page, IsFoundOnThisComputerAloneUnlessToldOtherwise) {
  open();
  EXPECT_EQ(page->url(), "http://127.0.0.1:" + std::to_string(port) + "/");
}

TEST(LivePageAt, AnAddressOfTheLoopbackIsNotOpenToTheNetwork) {
  const auto is_open = [](const char* host) {
    return LivePage({host, 0}, {}, {"a run", false}, {}).is_open_to_network();
  };
  EXPECT_TRUE(is_open("0.0.0.0"));
  for (const char* host : {"127.0.0.1", "127.0.0.2", "localhost"}) EXPECT_FALSE(is_open(host)) << host;
}

}  // namespace
}  // namespace geoloc::io
