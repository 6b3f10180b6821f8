// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "http_server.hpp"

namespace geoloc::io {

class HttpServer::Implementation {};

HttpServer::HttpServer(const HttpEndpoint& /*endpoint*/, const HttpLimits& /*limits*/,
                       const Headers& /*headers*/, Answer /*answer*/,
                       std::function<Events()> /*open_events*/) {
  throw std::runtime_error("this program was built without Boost 1.74 or newer (Debian: libboost-dev)");
}

HttpServer::~HttpServer() = default;

std::uint16_t HttpServer::port() const {
  return 0;
}

}  // namespace geoloc::io
