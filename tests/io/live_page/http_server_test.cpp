// SPDX-License-Identifier: Apache-2.0
#include "http_server.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

#include "loopback_client.hpp"

namespace geoloc::io {
namespace {

using testing::ask;
using testing::get_request;
using testing::kPatience;
using testing::LoopbackClient;
using namespace std::chrono_literals;

HttpLimits impatient() {
  HttpLimits limits;
  limits.head_time = 300ms;
  limits.write_time = 300ms;
  return limits;
}

/// Answers a request with its path.
class Server : public ::testing::Test {
 protected:
  static PageAnswer answer(const PageRequest& request) {
    if (request.path == "/large") return {200, "text/plain", std::string(1U << 24U, 'x'), false};
    return {200, "text/plain", request.path, false};
  }

  HttpServer server{{"127.0.0.1", 0}, impatient(), {}, answer, nullptr};
};

TEST_F(Server, AnswersGetWithABodyAndHeadWithItsLengthAlone) {
  const std::string get = ask(server.port(), get_request("/abc"));
  EXPECT_EQ(get.substr(get.find("\r\n\r\n")), "\r\n\r\n/abc");
  const std::string head = ask(server.port(), "HEAD /abc HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_NE(head.find("Content-Length: 4\r\n"), std::string::npos);
  EXPECT_EQ(head.substr(head.find("\r\n\r\n")), "\r\n\r\n");
}

TEST_F(Server, EndsAClientThatDribblesItsRequest) {
  const LoopbackClient client(server.port());
  const std::string request = get_request("/" + std::string(4000, 'a'));
  const auto begin = std::chrono::steady_clock::now();
  std::size_t sent = 0;
  while (sent < request.size() && client.send(request.substr(sent, 1)) && !client.is_ended(0ms)) {
    ++sent;
    std::this_thread::sleep_for(20ms);  // each byte on its own would be in time
  }
  EXPECT_TRUE(client.is_ended(kPatience));
  EXPECT_LT(sent, request.size());
  EXPECT_LT(std::chrono::steady_clock::now() - begin, kPatience);
}

TEST_F(Server, EndsAClientThatTakesItsAnswerTooSlowly) {
  const LoopbackClient client(server.port(), 4096);
  client.send(get_request("/large"));
  std::size_t taken = 0;
  while (true) {
    const std::string piece = client.read_until("\n\n", 1ms);
    if (piece.empty() && client.is_ended(1ms)) break;
    taken += piece.size();
    std::this_thread::sleep_for(500ms);  // never silent, but always behind
    ASSERT_LT(taken, 1U << 23U);
  }
  EXPECT_LT(taken, 1U << 23U);
}

TEST(ServerOfPatience, AnswersOthersWhileHundredsDribble) {
  HttpLimits limits;
  limits.head_time = 60s;
  const auto answer = [](const PageRequest& request) { return PageAnswer{200, "", request.path, false}; };
  const HttpServer server({"127.0.0.1", 0}, limits, {}, answer, nullptr);
  std::vector<std::unique_ptr<LoopbackClient>> dribbling;
  for (int i = 0; i < 200; ++i) {
    dribbling.push_back(std::make_unique<LoopbackClient>(server.port()));
    dribbling.back()->send("GET / HTTP/1.1\r\nX-And-So-On: ");
  }
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(ask(server.port(), get_request("/abc")).rfind("HTTP/1.1 200", 0), 0U) << i;
}

TEST_F(Server, IsFreeForTheNextAfterHundredsOfClientsThatLeft) {
  for (int i = 0; i < 300; ++i) {
    const LoopbackClient client(server.port());
    if (i % 2 == 0) client.send("GET /abc HT");
  }
  std::string last;
  for (const auto end = std::chrono::steady_clock::now() + kPatience;
       last.find("200 OK") == std::string::npos && std::chrono::steady_clock::now() < end;)
    last = ask(server.port(), get_request("/abc"));
  EXPECT_NE(last.find("200 OK"), std::string::npos);
}

TEST(ServerAt, AHostThatIsNotThisComputersIsNamed) {
  for (const char* const host : {"192.0.2.1", "no-such-host.invalid"}) {
    try {
      const HttpServer server({host, 0}, {}, {}, nullptr, nullptr);
      FAIL() << host;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(host), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("an address of this computer"), std::string::npos)
          << error.what();
    }
  }
}

TEST(ServerAt, AnIpV6AddressIsServed) {
  try {
    const HttpServer server({"::1", 0}, {}, {}, nullptr, nullptr);
    EXPECT_NE(server.port(), 0);
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << "no IPv6 here: " << error.what();
  }
}

}  // namespace
}  // namespace geoloc::io
