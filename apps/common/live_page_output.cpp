// SPDX-License-Identifier: Apache-2.0
#include "common/live_page_output.hpp"

#include <stdexcept>
#include <utility>

#include "common/network_address.hpp"
#include "common/qr_code.hpp"
#include "geoloc/io/live_page/page_token.hpp"
#include "geoloc/io/map/map_tiles.hpp"

namespace geoloc::apps {
namespace {

std::string token_of(const std::string& file) {
  if (file.empty()) return {};
  try {
    return io::read_or_make_page_token(file);
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("--http-token ") + error.what());
  }
}

io::PageMap page_map(const std::shared_ptr<const io::MapTiles>& tiles) {
  const auto tile = [tiles](const std::string& address) -> std::optional<std::string> {
    const auto parsed = io::parse_tile_address(address);
    return parsed ? tiles->tile(*parsed) : std::nullopt;
  };
  return {tile, tiles->attribution()};
}

io::PageMap map_of(const OutputOptions& options, const GroundOptions& ground) {
  if (options.map.empty() && !is_file(ground)) return {};
  try {
    return page_map(std::make_shared<io::MapTiles>(options.map.empty() ? io::MapTiles::relief(ground.ground)
                                                                       : io::MapTiles::picture(options.map)));
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string(options.map.empty() ? "--ground " : "--map ") + error.what());
  }
}

std::string warning_of(const OutputOptions& options) {
  if (!options.http_token.empty())
    return "\nThe page is open to the network, for those who have the token, and not encrypted: who can "
           "listen "
           "to the network can see it. docs/live_page.md says how to encrypt it";
  return "\nWARNING: --http serves the page, with the video and all coordinates, to EVERYONE who reaches "
         "this "
         "computer by network, without a password. To show it to those alone to whom you give a link, add "
         "--http-token FILE. To keep it to yourself, give --http PORT alone, and from another computer open "
         "a "
         "tunnel: ssh -L PORT:127.0.0.1:PORT THIS-COMPUTER";
}

/// A QR code of the page's address, and the address. Empty where the page is not open to the network, or this
/// computer is in none.
std::string for_telephones(const io::LivePage& page) {
  const auto address = network_address();
  if (!page.is_open_to_network() || !address) return {};
  const std::string query = page.token().empty() ? "" : "?token=" + page.token();
  const std::string url = page.url_for_others(*address) + query;
  return "\n" + qr_code(url) + "from a telephone in the same network: " + url;
}

}  // namespace

std::shared_ptr<io::LivePage> open_live_page(const OutputOptions& options, const GroundOptions& ground,
                                             const io::LivePageConfig& config, const io::LivePageTitle& title,
                                             const std::vector<std::string>& class_names,
                                             const Outputs& outputs,
                                             std::shared_ptr<io::ReplayControl> playback) {
  if (options.http.empty()) return nullptr;
  io::LivePageParts parts{token_of(options.http_token), outputs.notes(), std::move(playback),
                          map_of(options, ground)};
  try {
    return std::make_shared<io::LivePage>(io::parse_http_endpoint(options.http), config, title, class_names,
                                          std::move(parts));
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("--http: ") + error.what());
  }
}

std::string page_message(const io::LivePage& page, const OutputOptions& options, bool is_terminal) {
  std::string where = "page: " + page.url();
  if (!options.http_token.empty()) {
    where += is_terminal ? "?token=" + page.token() + " (the token is in " : " (asks for the token in ";
    where += options.http_token + ")";
  }
  if (page.is_open_to_network()) where += warning_of(options);
  return is_terminal ? where + for_telephones(page) : where;
}

}  // namespace geoloc::apps
