// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <string>

namespace geoloc::testing {

/// A socket on 127.0.0.1 for tests; receiving and accepting time out after 5 s.
class LoopbackSocket {
 public:
  explicit LoopbackSocket(int type, std::uint16_t port = 0) : descriptor_(socket(AF_INET, type, 0)) {
    const int reuse = 1;
    setsockopt(descriptor_, SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof reuse);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(descriptor_, reinterpret_cast<sockaddr*>(&address), size), 0);
    if (type == SOCK_STREAM) listen(descriptor_, 1);
    getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    const timeval patience{5, 0};
    setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
  ~LoopbackSocket() { close(descriptor_); }
  LoopbackSocket(const LoopbackSocket&) = delete;
  LoopbackSocket& operator=(const LoopbackSocket&) = delete;

  int descriptor() const { return descriptor_; }
  std::uint16_t port() const { return port_; }
  std::string url(const char* transport) const {
    return std::string(transport) + "://127.0.0.1:" + std::to_string(port_);
  }

 private:
  int descriptor_;
  std::uint16_t port_ = 0;
};

/// What is received next, or an empty text.
inline std::string receive(int descriptor, int flags = 0) {
  std::array<char, 2000> buffer;
  const ssize_t size = recv(descriptor, buffer.data(), buffer.size(), flags);
  return {buffer.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

}  // namespace geoloc::testing
