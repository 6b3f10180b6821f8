// SPDX-License-Identifier: Apache-2.0
#include "udp_sender.hpp"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

namespace geoloc::io {
namespace {

using AddressList = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

AddressList look_up(const Endpoint& receiver) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_DGRAM;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(receiver.host.c_str(), std::to_string(receiver.port).c_str(), &hints, &found);
  if (error != 0)
    throw std::runtime_error("the host " + receiver.host + " cannot be found: " + gai_strerror(error));
  return {found, &freeaddrinfo};
}

}  // namespace

UdpSender::UdpSender(const Endpoint& receiver) {
  const AddressList addresses = look_up(receiver);
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
