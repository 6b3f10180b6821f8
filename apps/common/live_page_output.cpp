// SPDX-License-Identifier: Apache-2.0
#include "common/live_page_output.hpp"

#include <stdexcept>

namespace geoloc::apps {

std::shared_ptr<io::LivePage> open_live_page(const std::string& endpoint, const io::LivePageConfig& config,
                                             const io::LivePageTitle& title,
                                             const std::vector<std::string>& class_names, Outputs& outputs) {
  if (endpoint.empty()) return nullptr;
  std::shared_ptr<io::LivePage> page;
  try {
    page = std::make_shared<io::LivePage>(io::parse_http_endpoint(endpoint), config, title, class_names);
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string("--http: ") + error.what());
  }
  outputs.add(std::make_unique<io::LivePageSink>(page));
  return page;
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
