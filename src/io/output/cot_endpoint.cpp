// SPDX-License-Identifier: Apache-2.0
#include <optional>
#include <stdexcept>

#include "geoloc/io/endpoint.hpp"
#include "geoloc/io/output/cot_connection.hpp"

namespace geoloc::io {
namespace {

std::optional<CotTransport> transport_of(const std::string& scheme) {
  if (scheme == "udp://") return CotTransport::kUdp;
  if (scheme == "tcp://") return CotTransport::kTcp;
  if (scheme == "tls://") return CotTransport::kTls;
  return std::nullopt;
}

}  // namespace

CotEndpoint parse_cot_endpoint(const std::string& text) {
  constexpr std::size_t kScheme = 6;  // letters
  constexpr std::size_t kLongestHost = 255;
  const auto transport = transport_of(text.substr(0, kScheme));
  const auto endpoint = transport ? parse_endpoint(text.substr(kScheme)) : std::nullopt;
  if (!endpoint || endpoint->host.size() > kLongestHost || endpoint->port == 0)
    throw std::invalid_argument("'" + text + "' is not udp://HOST:PORT, tcp://HOST:PORT or tls://HOST:PORT");
  return {*transport, endpoint->host, text.substr(text.rfind(':') + 1)};
}

}  // namespace geoloc::io
