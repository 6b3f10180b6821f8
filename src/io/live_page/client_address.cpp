// SPDX-License-Identifier: Apache-2.0
#include "client_address.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace geoloc::io {
namespace {

std::string text_of(int family, const void* address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  return inet_ntop(family, address, text.data(), text.size()) == nullptr ? "" : text.data();
}

ClientAddress from_v4(const in_addr& address) {
  constexpr unsigned kLoopbackNetwork = 127;
  return {text_of(AF_INET, &address), ntohl(address.s_addr) >> 24U == kLoopbackNetwork};
}

ClientAddress from_v6(in6_addr address) {
  if (IN6_IS_ADDR_V4MAPPED(&address)) {
    in_addr v4{};
    std::memcpy(&v4, &address.s6_addr[12], sizeof v4);
    return from_v4(v4);
  }
  const bool is_this_computer = IN6_IS_ADDR_LOOPBACK(&address) != 0;
  std::fill(std::begin(address.s6_addr) + 8, std::end(address.s6_addr), std::uint8_t{0});
  return {text_of(AF_INET6, &address), is_this_computer};
}

}  // namespace

ClientAddress client_address(const sockaddr_storage& peer) {
  if (peer.ss_family == AF_INET) return from_v4(reinterpret_cast<const sockaddr_in&>(peer).sin_addr);
  if (peer.ss_family == AF_INET6) return from_v6(reinterpret_cast<const sockaddr_in6&>(peer).sin6_addr);
  return {};
}

ClientAddress behind_proxy(const ClientAddress& proxy, const std::string& stated) {
  in_addr v4{};
  in6_addr v6{};
  if (!proxy.is_this_computer) return proxy;
  if (inet_pton(AF_INET, stated.c_str(), &v4) == 1) return from_v4(v4);
  if (inet_pton(AF_INET6, stated.c_str(), &v6) == 1) return from_v6(v6);
  return proxy;
}

ClientAddress client_address(int descriptor) {
  sockaddr_storage peer{};
  socklen_t size = sizeof peer;
  if (getpeername(descriptor, reinterpret_cast<sockaddr*>(&peer), &size) != 0) return {};
  return client_address(peer);
}

}  // namespace geoloc::io
