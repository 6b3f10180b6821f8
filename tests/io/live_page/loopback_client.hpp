// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace geoloc::io::testing {

/// For what must come; only a slow machine needs it.
constexpr std::chrono::seconds kPatience{20};

/// A TCP connection to a port of this computer that does as little of HTTP as a test wants.
class LoopbackClient {
 public:
  /// Throws std::runtime_error where nobody listens. `receive_buffer`: bytes; 0 leaves the system's.
  explicit LoopbackClient(std::uint16_t port, int receive_buffer = 0);
  ~LoopbackClient();
  LoopbackClient(const LoopbackClient&) = delete;
  LoopbackClient& operator=(const LoopbackClient&) = delete;

  /// False once the other side has closed.
  bool send(const std::string& text) const;

  /// What comes until `ending` is part of it, the connection ends, or the time is over.
  std::string read_until(const std::string& ending, std::chrono::milliseconds timeout) const;

  /// Whether the other side has ended the connection, within that time. Throws away what it said before.
  bool is_ended(std::chrono::milliseconds timeout) const;

 private:
  int descriptor_;
};

/// The head of a GET request as browsers send it.
std::string get_request(const std::string& path, const std::string& host = "127.0.0.1");

/// The whole answer to a request.
std::string ask(std::uint16_t port, const std::string& request);

}  // namespace geoloc::io::testing
