// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "geoloc/io/output/cot_connection.hpp"

namespace geoloc::io {
namespace {

bool is_port(const std::string& text) {
  int port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc{} && end == text.data() + text.size() && port >= 1 && port <= 65535;
}

bool is_host(const std::string& text, bool is_bracketed) {
  return !text.empty() && text.size() <= 255 && std::all_of(text.begin(), text.end(), [&](char c) {
    const bool is_name = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return is_name || c == '.' || c == '-' || (is_bracketed && (c == ':' || c == '%'));
  });
}

}  // namespace

CotEndpoint parse_cot_endpoint(const std::string& text) {
  CotEndpoint endpoint;
  const bool is_tcp = text.rfind("tcp://", 0) == 0;
  const bool is_known = is_tcp || text.rfind("udp://", 0) == 0;
  const std::string rest = is_known ? text.substr(6) : std::string();
  const std::size_t colon = rest.rfind(':');
  if (colon != std::string::npos) {
    endpoint.transport = is_tcp ? CotTransport::kTcp : CotTransport::kUdp;
    endpoint.host = rest.substr(0, colon);
    endpoint.port = rest.substr(colon + 1);
    const bool is_bracketed =
        endpoint.host.size() > 2 && endpoint.host.front() == '[' && endpoint.host.back() == ']';
    if (is_bracketed) endpoint.host = endpoint.host.substr(1, endpoint.host.size() - 2);
    if (is_host(endpoint.host, is_bracketed) && is_port(endpoint.port)) return endpoint;
  }
  throw std::invalid_argument("'" + text + "' is not udp://HOST:PORT or tcp://HOST:PORT");
}

}  // namespace geoloc::io
