// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/stream_url.hpp"

#include <algorithm>
#include <vector>

namespace geoloc::io {
namespace {

constexpr std::string_view kHidden = "…";
constexpr std::string_view kSchemeEnd = "://";

struct UrlParts {
  std::string_view scheme;  ///< with "://"
  std::string_view secret;  ///< user:password, without the "@"
  std::string_view host;    ///< and port
  std::string_view path;
  std::string_view parameters;
};

/// The last "@" ends the secret, wherever it is: a password that contains "/" or "@" must not show, and
/// hiding part of a path that contains "@" does no harm.
UrlParts split(std::string_view url) {
  UrlParts parts;
  const auto scheme_end = url.find(kSchemeEnd);
  const auto rest_at = scheme_end == std::string_view::npos ? 0 : scheme_end + kSchemeEnd.size();
  parts.scheme = url.substr(0, rest_at);
  std::string_view rest = url.substr(rest_at);
  if (const auto at = rest.rfind('@'); at != std::string_view::npos) {
    parts.secret = rest.substr(0, at);
    rest.remove_prefix(at + 1);
  }
  const auto host_end = std::min(rest.find_first_of("/?#"), rest.size());
  parts.host = rest.substr(0, host_end);
  rest.remove_prefix(host_end);
  auto path_end = std::min(rest.find_first_of("?#=&;"), rest.size());
  if (path_end < rest.size() && rest[path_end] != '?') path_end = rest.rfind('/', path_end) + 1;
  parts.path = rest.substr(0, path_end);
  parts.parameters = rest.substr(path_end);
  return parts;
}

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

}  // namespace

bool is_rtsp_url(std::string_view url) {
  const UrlParts parts = split(url);
  const auto is_printable = [](unsigned char c) { return c > ' ' && c != 0x7f; };
  const bool is_rtsp = parts.scheme == "rtsp://" || parts.scheme == "rtspt://" ||
                       parts.scheme == "rtspu://" || parts.scheme == "rtsps://";
  return is_rtsp && !parts.host.empty() && parts.host.front() != ':' &&
         std::all_of(url.begin(), url.end(), is_printable);
}

std::string without_credentials(std::string_view url) {
  const UrlParts parts = split(url);
  std::string shown{parts.scheme};
  if (!parts.secret.empty()) shown.append(kHidden).append("@");
  shown.append(parts.host).append(parts.path);
  if (!parts.parameters.empty()) shown.append(kHidden);
  return shown;
}

std::string without_credentials_of(std::string_view url, std::string text) {
  replace_all(text, url, without_credentials(url));
  const UrlParts parts = split(url);
  std::vector<std::string_view> secrets{parts.secret, parts.parameters};
  if (const auto colon = parts.secret.find(':'); colon != std::string_view::npos) {
    secrets.push_back(parts.secret.substr(colon + 1));
  }
  for (const std::string_view secret : secrets) {
    if (secret.size() > 1) replace_all(text, secret, kHidden);
  }
  return text;
}

}  // namespace geoloc::io
