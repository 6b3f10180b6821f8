// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "geoloc/io/endpoint.hpp"
#include "geoloc/io/output/cot_connection.hpp"

namespace geoloc::io {

CotEndpoint parse_cot_endpoint(const std::string& text) {
  constexpr std::size_t kLongestHost = 255;
  const bool is_tcp = text.rfind("tcp://", 0) == 0;
  const bool is_known = is_tcp || text.rfind("udp://", 0) == 0;
  const auto endpoint = is_known ? parse_endpoint(text.substr(6)) : std::nullopt;
  if (!endpoint || endpoint->host.size() > kLongestHost || endpoint->port == 0)
    throw std::invalid_argument("'" + text + "' is not udp://HOST:PORT or tcp://HOST:PORT");
  return {is_tcp ? CotTransport::kTcp : CotTransport::kUdp, endpoint->host, text.substr(text.rfind(':') + 1)};
}

}  // namespace geoloc::io
