// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_page_config.hpp"

#include <algorithm>
#include <stdexcept>

#include "geoloc/geometry/problems.hpp"
#include "geoloc/io/endpoint.hpp"

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
  Problems found;
  found.require(max_pages >= 1 && max_pages <= 1000, "live_page.max_pages must lie in [1, 1000]");
  found.require(update_period_s >= 0.02 && update_period_s <= 10,
                "live_page.update_period_s must lie in [0.02, 10]");
  found.require(write_timeout_s >= 0.1 && write_timeout_s <= 60,
                "live_page.write_timeout_s must lie in [0.1, 60]");
  found.require(picture_width_px >= 160 && picture_width_px <= 3840,
                "live_page.picture_width_px must lie in [160, 3840]");
  found.require(picture_period_s >= 0.02 && picture_period_s <= 60,
                "live_page.picture_period_s must lie in [0.02, 60]");
  found.require(tile_url.empty() || !tile_origin(tile_url).empty(),
                "live_page.tile_url must be http(s)://HOST/… with {z}, {x} and {y}");
  return found.take();
}

}  // namespace geoloc::io
