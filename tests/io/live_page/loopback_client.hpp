// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace geoloc::io::testing {

/// How long to wait for what must come; only a slow machine needs so long.
constexpr std::chrono::seconds kPatience{20};

/// A TCP connection to a port of this computer that speaks as little HTTP as a test wants.
class LoopbackClient {
 public:
  /// Throws std::runtime_error if nobody listens. `receive_buffer` is in bytes; 0 keeps the system's default.
  explicit LoopbackClient(std::uint16_t port, int receive_buffer = 0);
  ~LoopbackClient();
  LoopbackClient(const LoopbackClient&) = delete;
  LoopbackClient& operator=(const LoopbackClient&) = delete;

  /// False once the other side has closed.
  bool send(const std::string& text) const;

  /// Reads until the text contains `ending`, the connection ends, or the time is over.
  std::string read_until(const std::string& ending, std::chrono::milliseconds timeout) const;

  /// Whether the other side ends the connection within that time. Discards what it sends before.
  bool is_ended(std::chrono::milliseconds timeout) const;

 private:
  int descriptor_;
};

/// The head of a GET request as browsers send it.
std::string get_request(const std::string& path, const std::string& host = "127.0.0.1");

/// The whole answer to a request.
std::string ask(std::uint16_t port, const std::string& request);

}  // namespace geoloc::io::testing
