// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <string>

namespace geoloc::io {

/// Where a client connects from.
struct ClientAddress {
  /// An IPv4 address, or the first 64 bits of an IPv6 address: a single computer can have all the others.
  std::string network;
  bool is_this_computer = false;  ///< the loopback
};

/// Empty and another computer for what is no address of the internet.
ClientAddress client_address(const sockaddr_storage& peer);

/// The client of a proxy: the address that it states, if it is a proxy of this computer and that is one.
ClientAddress behind_proxy(const ClientAddress& proxy, const std::string& stated);

/// That of a connected socket.
ClientAddress client_address(int descriptor);

}  // namespace geoloc::io
