// SPDX-License-Identifier: Apache-2.0
// Uses the loopback only: nothing is sent to the multicast group on another interface.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>

#include <optional>
#include <thread>
#include <vector>

#include "geoloc/io/output/cot_connection.hpp"
#include "io/output/loopback_socket.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;
using Clock = CotConnection::Clock;
using testing::LoopbackSocket;
using testing::receive;

struct Connected {
  explicit Connected(const std::string& url, const CotConfig& config = {})
      : connection(parse_cot_endpoint(url), config,
                   [this](const std::string& message) { said.push_back(message); }) {}
  std::vector<std::string> said;
  CotConnection connection;
};

TEST(CotConnection, UdpSendsADatagramAnEvent) {
  const LoopbackSocket receiver(SOCK_DGRAM);
  Connected sender(receiver.url("udp"));
  sender.connection.poll(Clock::now());
  ASSERT_TRUE(sender.connection.is_ready());
  sender.connection.send("<event/>");
  EXPECT_EQ(receive(receiver.descriptor()), "<event/>");
}

TEST(CotConnection, MulticastStaysOnOneNetworkAndOnTheInterfaceGiven) {
  CotConfig config;
  config.multicast_interface = "lo";
  Connected sender("udp://239.2.3.1:6969", config);
  sender.connection.poll(Clock::now());
  ASSERT_GE(sender.connection.descriptor(), 0);
  unsigned char ttl = 0;
  socklen_t size = sizeof ttl;
  ASSERT_EQ(getsockopt(sender.connection.descriptor(), IPPROTO_IP, IP_MULTICAST_TTL, &ttl, &size), 0);
  EXPECT_EQ(ttl, 1);
  ip_mreqn multicast{};
  size = sizeof multicast;
  ASSERT_EQ(getsockopt(sender.connection.descriptor(), IPPROTO_IP, IP_MULTICAST_IF, &multicast, &size), 0);
  sockaddr_in peer{};
  size = sizeof peer;
  ASSERT_EQ(getpeername(sender.connection.descriptor(), reinterpret_cast<sockaddr*>(&peer), &size), 0);
  EXPECT_EQ(peer.sin_addr.s_addr, inet_addr("239.2.3.1"));
  EXPECT_EQ(ntohs(peer.sin_port), 6969);
}

TEST(CotConnection, AnInterfaceThatIsNotThereIsTold) {
  CotConfig config;
  config.multicast_interface = "none0";
  Connected sender("udp://239.2.3.1:6969", config);
  sender.connection.poll(Clock::now());
  EXPECT_FALSE(sender.connection.is_ready());
  ASSERT_EQ(sender.said.size(), 1U);
  EXPECT_NE(sender.said.front().find("none0"), std::string::npos);
}

TEST(CotConnection, TcpComesBackWhenTheServerDoes) {
  std::optional<LoopbackSocket> server(SOCK_STREAM);
  const std::uint16_t port = server->port();
  Connected sender(server->url("tcp"));
  ASSERT_TRUE(sender.connection.flush(5s));
  sender.connection.send("<one/>");
  int client = accept(server->descriptor(), nullptr, nullptr);
  EXPECT_EQ(receive(client), "<one/>");

  close(client);
  server.reset();
  for (int i = 0; i < 500 && sender.connection.is_ready(); ++i) {
    sender.connection.poll(Clock::now());
    std::this_thread::sleep_for(10ms);
  }
  ASSERT_FALSE(sender.connection.is_ready());
  ASSERT_EQ(sender.said.size(), 1U);

  server.emplace(SOCK_STREAM, port);
  ASSERT_TRUE(sender.connection.flush(10s));
  EXPECT_EQ(sender.connection.counts().connections, 2U);
  EXPECT_EQ(sender.said.size(), 1U);
  sender.connection.poll(Clock::now() + 3s);
  EXPECT_EQ(sender.said.size(), 2U);  // reported once that it went, and once that it is back to stay
  sender.connection.send("<two/>");
  client = accept(server->descriptor(), nullptr, nullptr);
  EXPECT_EQ(receive(client), "<two/>");
  close(client);
}

TEST(CotConnection, AServerThatTakesNothingIsGivenUpAndNothingWaits) {
  const LoopbackSocket server(SOCK_STREAM);  // connections are accepted by the system's queue, and never read
  Connected sender(server.url("tcp"));
  ASSERT_TRUE(sender.connection.flush(5s));
  const std::string event(1000, 'x');
  const auto begin = Clock::now();
  for (int i = 0; i < 100'000 && sender.connection.is_ready(); ++i) sender.connection.send(event);
  EXPECT_LT(Clock::now() - begin, 5s);
  ASSERT_FALSE(sender.connection.is_ready());
  ASSERT_GE(sender.connection.descriptor(), 0);
  sender.connection.poll(Clock::now() + 11s);
  EXPECT_LT(sender.connection.descriptor(), 0);
}

TEST(CotConnection, AServerThatHangsUpOnEveryoneIsAskedLessAndLessOften) {
  const LoopbackSocket server(SOCK_STREAM);
  fcntl(server.descriptor(), F_SETFL, O_NONBLOCK);
  Connected sender(server.url("tcp"));
  auto now = Clock::now();
  for (int i = 0; i < 600; ++i) {  // a minute
    sender.connection.poll(now);
    now += 100ms;
    const int client = accept(server.descriptor(), nullptr, nullptr);
    if (client >= 0) close(client);
  }
  EXPECT_EQ(sender.said.size(), 1U);
  EXPECT_LE(sender.connection.counts().connections, 7U);
  EXPECT_GE(sender.connection.counts().connections, 2U);
}

TEST(CotConnection, ADeadServerIsAskedLessAndLessOften) {
  std::uint16_t port = 0;
  {
    const LoopbackSocket gone(SOCK_STREAM);
    port = gone.port();
  }
  Connected sender("tcp://127.0.0.1:" + std::to_string(port));
  auto now = Clock::now();
  int attempts = 0;
  for (int i = 0; i < 3000; ++i) {  // 5 minutes
    sender.connection.poll(now);
    now += 100ms;
    attempts += sender.connection.descriptor() >= 0 ? 1 : 0;
  }
  EXPECT_LE(attempts, 40);
  EXPECT_EQ(sender.said.size(), 1U);
}

}  // namespace
}  // namespace geoloc::io
