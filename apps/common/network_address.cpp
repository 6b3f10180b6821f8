// SPDX-License-Identifier: Apache-2.0
#include "common/network_address.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <array>
#include <memory>
#include <string_view>

namespace geoloc::apps {
namespace {

bool is_for_devices(const ifaddrs& entry) {
  const bool is_up = (entry.ifa_flags & IFF_UP) != 0 && (entry.ifa_flags & IFF_LOOPBACK) == 0;
  if (!is_up || entry.ifa_addr == nullptr || entry.ifa_addr->sa_family != AF_INET) return false;
  const std::string_view name = entry.ifa_name;
  return name.rfind("docker", 0) != 0 && name.rfind("br-", 0) != 0 && name.rfind("veth", 0) != 0;
}

}  // namespace

std::optional<std::string> network_address() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return std::nullopt;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(first, &freeifaddrs);
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    if (!is_for_devices(*entry)) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto& address = reinterpret_cast<const sockaddr_in&>(*entry->ifa_addr);
    if (inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size()) != nullptr) return text.data();
  }
  return std::nullopt;
}

}  // namespace geoloc::apps
