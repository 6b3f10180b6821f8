// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "geoloc/io/endpoint.hpp"

namespace geoloc::io {

/// Sends datagrams to one receiver, whether or not there is one. Multicast stays in the network that it is
/// sent to.
class UdpSender {
 public:
  /// Throws std::runtime_error naming the host where it cannot be found.
  explicit UdpSender(const Endpoint& receiver);
  ~UdpSender();
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;

  /// Waits for the network's interface. What it does not take is lost.
  void send(std::string_view datagram) const;

 private:
  int descriptor_ = -1;
};

}  // namespace geoloc::io
