// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "geoloc/io/live_page/live_page_config.hpp"

namespace geoloc::io {

/// A TCP port on which clients are accepted.
class ListeningSocket {
 public:
  /// `send_buffer_bytes` of each accepted connection. Throws std::runtime_error that names the endpoint, the
  /// reason and the remedy.
  ListeningSocket(const HttpEndpoint& endpoint, int send_buffer_bytes);
  ~ListeningSocket();
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;

  std::uint16_t port() const;

  /// Waits for the next client and returns its descriptor, which the caller closes; -1 once `stop_descriptor`
  /// is readable.
  int accept(int stop_descriptor);

 private:
  struct Acceptor;
  std::unique_ptr<Acceptor> acceptor_;
};

}  // namespace geoloc::io
