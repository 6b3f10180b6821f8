// SPDX-License-Identifier: Apache-2.0
#include "udp_sender.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

#include "geoloc/io/address_lookup.hpp"

namespace geoloc::io {
UdpSender::UdpSender(const Endpoint& receiver) {
  const auto [addresses, fault] = look_up(receiver.host, std::to_string(receiver.port), SOCK_DGRAM);
  if (!addresses) throw std::runtime_error("the host " + receiver.host + " cannot be found: " + fault);
  int reason = EADDRNOTAVAIL;
  for (const addrinfo* address = addresses.get(); address != nullptr; address = address->ai_next) {
    descriptor_ = ::socket(address->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (descriptor_ >= 0 && ::connect(descriptor_, address->ai_addr, address->ai_addrlen) == 0) return;
    reason = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  throw std::runtime_error("nothing can be sent to " + receiver.host + ": " +
                           std::generic_category().message(reason));
}

UdpSender::~UdpSender() {
  ::close(descriptor_);
}

void UdpSender::send(std::string_view datagram) const {
  while (::send(descriptor_, datagram.data(), datagram.size(), MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

}  // namespace geoloc::io
