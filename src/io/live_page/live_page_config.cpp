// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_page_config.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>

#include "geoloc/geometry/problems.hpp"

namespace geoloc::io {
namespace {

std::optional<std::uint16_t> parse_port(const std::string& text) {
  std::uint16_t port = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped_at, error] = std::from_chars(text.data(), end, port);
  if (text.empty() || error != std::errc{} || stopped_at != end) return std::nullopt;
  return port;
}

bool is_name_character(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '-';
}

/// The host of "HOST" or "[IPV6]"; empty where it is neither.
std::string parse_host(const std::string& text) {
  const bool is_bracketed = text.size() > 2 && text.front() == '[' && text.back() == ']';
  const std::string host = is_bracketed ? text.substr(1, text.size() - 2) : text;
  const bool is_host = std::all_of(host.begin(), host.end(), [&](char c) {
    return is_name_character(c) || (is_bracketed && (c == ':' || c == '%'));
  });
  return is_host ? host : "";
}

bool starts_with(const std::string& text, const char* beginning) {
  return text.rfind(beginning, 0) == 0;
}

}  // namespace

HttpEndpoint parse_http_endpoint(const std::string& text) {
  HttpEndpoint endpoint;
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos) endpoint.host = parse_host(text.substr(0, colon));
  const auto port = parse_port(colon == std::string::npos ? text : text.substr(colon + 1));
  if (endpoint.host.empty() || !port)
    throw std::invalid_argument("'" + text + "' is not PORT, HOST:PORT or [IPV6]:PORT");
  endpoint.port = *port;
  return endpoint;
}

std::string tile_origin(const std::string& tile_url) {
  if (!starts_with(tile_url, "https://") && !starts_with(tile_url, "http://")) return "";
  for (const char* part : {"{z}", "{x}", "{y}"}) {
    if (tile_url.find(part) == std::string::npos) return "";
  }
  const std::size_t host_begin = tile_url.find("//") + 2;
  const std::string host = tile_url.substr(host_begin, tile_url.find('/', host_begin) - host_begin);
  const bool is_host = !host.empty() && std::all_of(host.begin(), host.end(),
                                                    [](char c) { return is_name_character(c) || c == ':'; });
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
