// SPDX-License-Identifier: Apache-2.0
#include "common/live_page_output.hpp"

#include <stdexcept>
#include <utility>

#include "common/network_address.hpp"
#include "common/qr_code.hpp"

namespace geoloc::apps {

std::shared_ptr<io::LivePage> open_live_page(const std::string& endpoint, const io::LivePageConfig& config,
                                             const io::LivePageTitle& title,
                                             const std::vector<std::string>& class_names,
                                             const Outputs& outputs,
                                             std::shared_ptr<io::ReplayControl> playback) {
  if (endpoint.empty()) return nullptr;
  try {
    return std::make_shared<io::LivePage>(io::parse_http_endpoint(endpoint), config, title, class_names,
                                          outputs.notes(), std::move(playback));
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("--http: ") + error.what());
  }
}

std::string page_for_telephones(const io::LivePage& page) {
  const auto address = network_address();
  if (!page.is_open_to_network() || !address) return {};
  const std::string url = page.url_for_others(*address);
  return qr_code(url) + "from a telephone in the same network: " + url;
}

std::string page_message(const io::LivePage& page) {
  const std::string where = "page: " + page.url();
  if (!page.is_open_to_network()) return where;
  return where +
         "\nWARNING: --http serves the page, with the video and all coordinates, to EVERYONE who reaches "
         "this "
         "computer by network, without a password. To keep it to yourself, give --http PORT alone, and from "
         "another computer open a tunnel: ssh -L PORT:127.0.0.1:PORT THIS-COMPUTER";
}

}  // namespace geoloc::apps
