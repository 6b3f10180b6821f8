// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_page_config.hpp"

#include <algorithm>
#include <stdexcept>

#include "geoloc/io/endpoint.hpp"
#include "io/live_page/live_page_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc::io {
namespace {

bool starts_with(const std::string& text, const char* beginning) {
  return text.rfind(beginning, 0) == 0;
}

}  // namespace

HttpEndpoint parse_http_endpoint(const std::string& text) {
  const auto endpoint = parse_endpoint(text, HttpEndpoint{}.host);
  if (!endpoint) throw std::invalid_argument("'" + text + "' is not PORT, HOST:PORT or [IPV6]:PORT");
  return {endpoint->host, endpoint->port};
}

std::string tile_origin(const std::string& tile_url) {
  if (!starts_with(tile_url, "https://") && !starts_with(tile_url, "http://")) return "";
  for (const char* part : {"{z}", "{x}", "{y}"}) {
    if (tile_url.find(part) == std::string::npos) return "";
  }
  const std::size_t host_begin = tile_url.find("//") + 2;
  const std::string host = tile_url.substr(host_begin, tile_url.find('/', host_begin) - host_begin);
  const bool is_host = !host.empty() && std::all_of(host.begin(), host.end(),
                                                    [](char c) { return is_host_character(c) || c == ':'; });
  return is_host ? tile_url.substr(0, host_begin) + host : "";
}

std::vector<std::string> LivePageConfig::problems() const {
  return check_fields(*this);
}

}  // namespace geoloc::io
