// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/udp_socket.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>

#include <cstring>
#include <stdexcept>

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

const UdpEndpoint kAnyLoopbackPort{"127.0.0.1", 0};
constexpr std::uint8_t kPing[] = {1, 2, 3};
constexpr auto kLongEnough = 5000ms;  // loopback takes microseconds; this long only on a stalled machine

/// A port of this computer as a peer.
UdpPeer loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  UdpPeer peer;
  std::memcpy(&peer.address, &address, sizeof address);
  peer.address_size = sizeof address;
  return peer;
}

TEST(UdpSocket, AnswersWhoSpokeToIt) {
  UdpSocket vehicle(kAnyLoopbackPort), link(kAnyLoopbackPort);
  vehicle.answer(loopback(link.local_port()));
  link.send(kPing, sizeof kPing);
  EXPECT_EQ(link.counts().sent, 0U) << "nobody to answer yet";

  vehicle.send(kPing, sizeof kPing);
  const auto received = link.receive(kLongEnough);
  ASSERT_TRUE(received);
  EXPECT_EQ(std::vector<std::uint8_t>(received->data, received->data + received->size),
            std::vector<std::uint8_t>(kPing, kPing + sizeof kPing));
  link.answer(received->sender);
  link.send(kPing, 2);
  const auto answer = vehicle.receive(kLongEnough);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->size, 2U);
}

TEST(UdpSocket, GivesUpWaiting) {
  UdpSocket socket(kAnyLoopbackPort);
  EXPECT_FALSE(socket.receive(1ms));
}

TEST(UdpSocket, SurvivesAPeerThatIsGone) {
  UdpSocket socket(kAnyLoopbackPort);
  {
    UdpSocket gone(kAnyLoopbackPort);
    socket.answer(loopback(gone.local_port()));
  }
  for (int i = 0; i < 10; ++i) {
    socket.send(kPing, sizeof kPing);
    EXPECT_FALSE(socket.receive(1ms));
  }
  EXPECT_EQ(socket.counts().sent + socket.counts().send_errors, 10U);
}

TEST(UdpSocket, CountsDatagramsThatAreTooLongToSend) {
  UdpSocket socket(kAnyLoopbackPort);
  socket.answer(loopback(socket.local_port()));
  const std::vector<std::uint8_t> huge(70'000);
  socket.send(huge.data(), huge.size());
  EXPECT_EQ(socket.counts().send_errors, 1U);
}

TEST(UdpSocket, SaysWhoMayHoldThePort) {
  const UdpSocket first(kAnyLoopbackPort);
  try {
    UdpSocket second({"127.0.0.1", first.local_port()});
    FAIL() << "two sockets on one port";
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(std::to_string(first.local_port())), std::string::npos) << message;
    EXPECT_NE(message.find("--udp"), std::string::npos) << message;
  }
}

TEST(UdpSocket, RefusesAddressesOfOtherComputers) {
  EXPECT_THROW(UdpSocket({"192.0.2.1", 0}), std::runtime_error);
  EXPECT_THROW(UdpSocket({"no.such.host.invalid", 0}), std::runtime_error);
}

TEST(UdpEndpoint, ReadsPortsAndHosts) {
  EXPECT_EQ(parse_udp_endpoint("14550").host, "0.0.0.0");
  EXPECT_EQ(parse_udp_endpoint("14550").port, 14550);
  EXPECT_EQ(parse_udp_endpoint("127.0.0.1:14551").host, "127.0.0.1");
  EXPECT_EQ(parse_udp_endpoint("127.0.0.1:14551").port, 14551);
  EXPECT_EQ(parse_udp_endpoint("ground-station.local:1").host, "ground-station.local");
  EXPECT_EQ(parse_udp_endpoint("[::1]:65535").host, "::1");
  EXPECT_EQ(parse_udp_endpoint("[::1]:65535").port, 65535);
}

TEST(UdpEndpoint, RefusesAnythingElse) {
  for (const char* const text : {"", "host", "host:", ":14550", "14550 ", "::1:14550", "udp://1.2.3.4:5"}) {
    EXPECT_THROW(parse_udp_endpoint(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace geoloc::io
