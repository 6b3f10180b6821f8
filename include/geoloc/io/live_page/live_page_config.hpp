// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace geoloc::io {

/// "live_page" in the configuration file.
struct LivePageConfig {
  int max_pages = 64;  ///< open at a time
  double update_period_s = 0.1;
  double write_timeout_s = 5.0;
  int picture_width_px = 960;
  double picture_period_s = 0.2;
  std::string tile_url;          ///< of a background map, with {z} {x} {y}; empty: a metric grid alone
  std::string tile_attribution;  ///< what its maker wants to be read beside it

  /// Every fault, named by its path.
  std::vector<std::string> problems() const;
};

/// Where the page is served.
struct HttpEndpoint {
  std::string host = "127.0.0.1";  ///< address or name of this computer; 0.0.0.0 is every interface
  std::uint16_t port = 0;          ///< 0: one that is free
};

/// "PORT" (this computer alone), "HOST:PORT" or "[IPV6]:PORT". Throws std::invalid_argument that shows the
/// text.
HttpEndpoint parse_http_endpoint(const std::string& text);

/// "https://tiles.example.org:8443" of a tile URL: what a page must be allowed to load from. Empty for an
/// empty URL, and for one that is not http(s) with {z}, {x} and {y}.
std::string tile_origin(const std::string& tile_url);

}  // namespace geoloc::io
