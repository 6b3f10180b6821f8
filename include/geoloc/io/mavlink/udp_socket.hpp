// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/mavlink/link_source.hpp"

namespace geoloc::io {

struct UdpEndpoint {
  std::string host = "0.0.0.0";  ///< address or name; 0.0.0.0 is every interface of this computer
  std::uint16_t port = 14550;    ///< 0: one that is free
};

/// "PORT" (every interface), "HOST:PORT" or "[IPV6]:PORT". Throws std::invalid_argument that shows the text.
UdpEndpoint parse_udp_endpoint(const std::string& text);

/// Where a datagram came from.
struct UdpPeer {
  sockaddr_storage address{};
  socklen_t address_size = 0;
};

LinkSource source_of(const UdpPeer& peer);

/// A bound UDP socket that answers one peer. Anyone who reaches the port can send to it, so input must be
/// checked.
class UdpSocket {
 public:
  struct Datagram {
    const std::uint8_t* data;  ///< valid until the next receive()
    std::size_t size;
    UdpPeer sender;
  };

  struct Counts {
    std::uint64_t received = 0;
    std::uint64_t receive_errors = 0;
    std::uint64_t sent = 0;
    std::uint64_t send_errors = 0;
  };

  /// Throws std::runtime_error that names the endpoint, the reason and the remedy.
  explicit UdpSocket(const UdpEndpoint& endpoint);
  ~UdpSocket();
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  /// Waits for one datagram; nullopt after `timeout`, on a signal, or when the network reported an error.
  std::optional<Datagram> receive(std::chrono::milliseconds timeout);

  /// Makes `peer` the destination of send().
  void answer(const UdpPeer& peer) { peer_ = peer; }

  /// Sends without waiting. Failures are counted, never thrown; without a peer nothing is sent.
  void send(const std::uint8_t* data, std::size_t size);

  std::uint16_t local_port() const;
  const Counts& counts() const { return counts_; }

 private:
  int descriptor_ = -1;
  std::vector<std::uint8_t> buffer_;
  std::optional<UdpPeer> peer_;
  Counts counts_;
};

}  // namespace geoloc::io
