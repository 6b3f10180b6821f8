// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "geoloc/io/live_page/live_page_config.hpp"
#include "geoloc/io/live_page/live_site.hpp"

namespace geoloc::io {

/// Limits to the resources that one client, and all of them together, can use.
struct HttpLimits {
  std::size_t connections = 96;    ///< at a time; a further one ends that whose request takes longest
  std::size_t event_streams = 64;  ///< of these
  std::size_t head_bytes = 16384;  ///< of a request; there are no bodies
  std::chrono::milliseconds head_time{5000};   ///< for all of a request
  std::chrono::milliseconds write_time{5000};  ///< by which a client may be behind slowest_bytes_per_s
  double slowest_bytes_per_s = 16384.0;
};

/// HTTP/1.1 with one request per connection, each connection in a thread of a bounded pool.
class HttpServer {
 public:
  using Answer = std::function<PageAnswer(const PageRequest&)>;
  /// Waits for the next event's text; nullopt ends the stream. One function is made per stream.
  using Events = std::function<std::optional<std::string>()>;

  /// Throws std::runtime_error that names the endpoint, the reason and the remedy.
  HttpServer(const HttpEndpoint& endpoint, const HttpLimits& limits, const Headers& headers, Answer answer,
             std::function<Events()> open_events);
  /// Cuts every connection; `Events` must return soon.
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  std::uint16_t port() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace geoloc::io
