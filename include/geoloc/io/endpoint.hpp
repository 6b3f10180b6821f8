// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace geoloc::io {

struct Endpoint {
  std::string host;  ///< address or name, without brackets
  std::uint16_t port = 0;
};

/// Whether a character may occur in a host name or an IPv4 address.
inline bool is_host_character(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '-';
}

/// Whether a host is this computer, by its name or its loopback address. It is not looked up.
inline bool is_loopback(const std::string& host) {
  return host == "localhost" || host == "::1" || host.rfind("127.", 0) == 0;
}

/// The whole text as 0 to 65535, digits only.
inline std::optional<std::uint16_t> parse_port(const std::string& text) {
  std::uint16_t port = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped_at, error] = std::from_chars(text.data(), end, port);
  if (error != std::errc{} || stopped_at != end) return std::nullopt;
  return port;
}

/// The host of "HOST" or "[IPV6]": not empty and made of valid characters. It is not looked up.
inline std::optional<std::string> parse_host(const std::string& text) {
  const bool is_bracketed = text.size() > 2 && text.front() == '[' && text.back() == ']';
  std::string host = is_bracketed ? text.substr(1, text.size() - 2) : text;
  const bool is_host = !host.empty() && std::all_of(host.begin(), host.end(), [&](char c) {
    return is_host_character(c) || (is_bracketed && (c == ':' || c == '%'));
  });
  if (!is_host) return std::nullopt;
  return host;
}

/// "HOST:PORT", "[IPV6]:PORT", or "PORT" if there is a default host. nullopt for anything else.
inline std::optional<Endpoint> parse_endpoint(const std::string& text,
                                              std::optional<std::string> host_of_port_alone = std::nullopt) {
  const std::size_t colon = text.rfind(':');
  const bool is_port_alone = colon == std::string::npos;
  auto host = is_port_alone ? std::move(host_of_port_alone) : parse_host(text.substr(0, colon));
  const auto port = parse_port(is_port_alone ? text : text.substr(colon + 1));
  if (!host || !port) return std::nullopt;
  return Endpoint{*std::move(host), *port};
}

}  // namespace geoloc::io
