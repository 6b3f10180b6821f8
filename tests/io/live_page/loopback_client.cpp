// SPDX-License-Identifier: Apache-2.0
#include "loopback_client.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace geoloc::io::testing {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

LoopbackClient::LoopbackClient(std::uint16_t port, int receive_buffer)
    : descriptor_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  if (receive_buffer > 0)
    setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    close(descriptor_);
    throw std::runtime_error("nobody listens");
  }
}

LoopbackClient::~LoopbackClient() {
  close(descriptor_);
}

bool LoopbackClient::send(const std::string& text) const {
  return ::send(descriptor_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
}

std::string LoopbackClient::read_until(const std::string& ending, std::chrono::milliseconds timeout) const {
  const auto deadline = Clock::now() + timeout;
  std::string text;
  std::array<char, 65536> piece{};
  while (text.find(ending) == std::string::npos) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    pollfd waiting{descriptor_, POLLIN, 0};
    if (left.count() <= 0 || poll(&waiting, 1, static_cast<int>(left.count())) <= 0) break;
    const ssize_t size = recv(descriptor_, piece.data(), piece.size(), 0);
    if (size <= 0) break;
    text.append(piece.data(), static_cast<std::size_t>(size));
  }
  return text;
}

bool LoopbackClient::is_ended(std::chrono::milliseconds timeout) const {
  const auto deadline = Clock::now() + timeout;
  std::array<char, 65536> piece{};
  while (Clock::now() < deadline) {
    pollfd waiting{descriptor_, POLLIN, 0};
    if (poll(&waiting, 1, 20) > 0 && recv(descriptor_, piece.data(), piece.size(), 0) <= 0) return true;
  }
  return false;
}

std::string get_request(const std::string& path, const std::string& host) {
  return "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n";
}

std::string ask(std::uint16_t port, const std::string& request) {
  const LoopbackClient client(port);
  client.send(request);
  return client.read_until("\1never\1", std::chrono::seconds{10});
}

}  // namespace geoloc::io::testing
