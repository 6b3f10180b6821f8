// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/udp_socket.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "geoloc/io/address_lookup.hpp"
#include "geoloc/io/endpoint.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kLargestDatagram = 65536;
constexpr std::size_t kMapped = 12;  // bytes before an IPv4 address in one of IPv6

AddressList resolve(const UdpEndpoint& endpoint) {
  AddressLookup found = look_up(endpoint.host, std::to_string(endpoint.port), SOCK_DGRAM);
  if (!found.addresses) {
    throw std::runtime_error("UDP " + endpoint.host + ":" + std::to_string(endpoint.port) + ": " +
                             found.fault + "; give an address of this computer, or the port alone");
  }
  return std::move(found.addresses);
}

[[noreturn]] void fail_to_bind(const UdpEndpoint& endpoint, int error) {
  std::string message = "UDP " + endpoint.host + ":" + std::to_string(endpoint.port) + ": " +
                        std::generic_category().message(error);
  if (error == EADDRINUSE) {
    message +=
        "; another program, perhaps a ground station, holds the port: close it, take another port with "
        "--udp, or "
        "share the vehicle's link through mavlink-router or MAVProxy";
  } else if (error == EADDRNOTAVAIL) {
    message += "; the host must be an address of this computer";
  } else if (error == EACCES) {
    message += "; ports below 1024 are for the system, take another with --udp";
  }
  throw std::runtime_error(message);
}

int open_bound_socket(const UdpEndpoint& endpoint) {
  const AddressList address = resolve(endpoint);
  const int descriptor = socket(address->ai_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (descriptor < 0) fail_to_bind(endpoint, errno);
  if (bind(descriptor, address->ai_addr, address->ai_addrlen) != 0) {
    const int error = errno;
    close(descriptor);
    fail_to_bind(endpoint, error);
  }
  return descriptor;
}

}  // namespace

UdpEndpoint parse_udp_endpoint(const std::string& text) {
  const auto endpoint = parse_endpoint(text, UdpEndpoint{}.host);
  if (!endpoint) throw std::invalid_argument("'" + text + "' is not PORT, HOST:PORT or [IPV6]:PORT");
  return {endpoint->host, endpoint->port};
}

LinkSource source_of(const UdpPeer& peer) {
  LinkSource source;
  if (peer.address.ss_family == AF_INET6) {
    const auto& address = reinterpret_cast<const sockaddr_in6&>(peer.address);
    std::copy_n(address.sin6_addr.s6_addr, source.address.size(), source.address.begin());
    source.port = ntohs(address.sin6_port);
  } else if (peer.address.ss_family == AF_INET) {
    const auto& address = reinterpret_cast<const sockaddr_in&>(peer.address);
    source.address[kMapped - 2] = source.address[kMapped - 1] = 0xFF;
    std::memcpy(&source.address[kMapped], &address.sin_addr, sizeof address.sin_addr);
    source.port = ntohs(address.sin_port);
  }
  return source;
}

std::string to_string(const LinkSource& source) {
  in6_addr address{};
  std::copy(source.address.begin(), source.address.end(), address.s6_addr);
  const bool is_v4 = IN6_IS_ADDR_V4MAPPED(&address);
  char text[INET6_ADDRSTRLEN] = {};
  if (is_v4) {
    inet_ntop(AF_INET, &source.address[kMapped], text, sizeof text);
  } else {
    inet_ntop(AF_INET6, &address, text, sizeof text);
  }
  const std::string host = is_v4 ? text : "[" + std::string(text) + "]";
  return host + ":" + std::to_string(source.port);
}

UdpSocket::UdpSocket(const UdpEndpoint& endpoint)
    : descriptor_(open_bound_socket(endpoint)), buffer_(kLargestDatagram) {}

UdpSocket::~UdpSocket() {
  close(descriptor_);
}

std::optional<UdpSocket::Datagram> UdpSocket::receive(std::chrono::milliseconds timeout) {
  pollfd waiting{descriptor_, POLLIN, 0};
  if (poll(&waiting, 1, static_cast<int>(timeout.count())) <= 0) return std::nullopt;
  Datagram datagram{buffer_.data(), 0, {}};
  datagram.sender.address_size = sizeof datagram.sender.address;
  const ssize_t size =
      recvfrom(descriptor_, buffer_.data(), buffer_.size(), 0,
               reinterpret_cast<sockaddr*>(&datagram.sender.address), &datagram.sender.address_size);
  if (size < 0) {  // ECONNREFUSED, for example, because nobody listened for an earlier datagram
    if (errno != EAGAIN && errno != EINTR) ++counts_.receive_errors;
    return std::nullopt;
  }
  ++counts_.received;
  datagram.size = static_cast<std::size_t>(size);
  return datagram;
}

void UdpSocket::send(const std::uint8_t* data, std::size_t size) {
  if (!peer_) return;
  const ssize_t sent = sendto(descriptor_, data, size, MSG_NOSIGNAL,
                              reinterpret_cast<const sockaddr*>(&peer_->address), peer_->address_size);
  if (sent == static_cast<ssize_t>(size)) {
    ++counts_.sent;
  } else {
    ++counts_.send_errors;
  }
}

std::uint16_t UdpSocket::local_port() const {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  const bool is_v6 = address.ss_family == AF_INET6;
  return ntohs(is_v6 ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                     : reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

}  // namespace geoloc::io
