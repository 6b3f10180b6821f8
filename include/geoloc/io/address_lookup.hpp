// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <netdb.h>

#include <memory>
#include <string>

namespace geoloc::io {

using AddressList = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

/// What the system's resolver says of a host.
struct AddressLookup {
  AddressList addresses{nullptr, &freeaddrinfo};
  std::string fault;  ///< why there are none; empty where there are
};

/// `port` is a number; `socket_type` is SOCK_STREAM or SOCK_DGRAM. May wait for the network.
inline AddressLookup look_up(const std::string& host, const std::string& port, int socket_type) {
  addrinfo hints{};
  hints.ai_socktype = socket_type;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int status = getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
  if (status != 0) return {AddressList(nullptr, &freeaddrinfo), gai_strerror(status)};
  return {AddressList(found, &freeaddrinfo), {}};
}

}  // namespace geoloc::io
