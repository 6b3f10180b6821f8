// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/klv/klv_target.hpp"

#include <stdexcept>

namespace geoloc::io {

std::optional<Endpoint> parse_klv_target(const std::string& target) {
  constexpr const char* kScheme = "udp://";
  constexpr std::size_t kSchemeLength = 6, kLongestHost = 255;
  if (target.find("://") == std::string::npos) return std::nullopt;
  const bool is_udp = target.rfind(kScheme, 0) == 0;
  auto receiver = is_udp ? parse_endpoint(target.substr(kSchemeLength)) : std::nullopt;
  if (!receiver || receiver->host.size() > kLongestHost || receiver->port == 0)
    throw std::invalid_argument("'" + target + "' is neither udp://HOST:PORT nor the name of a file");
  return receiver;
}

}  // namespace geoloc::io
