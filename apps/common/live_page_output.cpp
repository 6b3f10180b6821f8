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

}  // namespace geoloc::apps
