// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

#include "http_server.hpp"

namespace geoloc::io {

/// One client's connection, with an end to everything: to the time that a request takes, to the
/// patience with one who does not take what is written, and to all of it once the server stops.
class ClientSocket {
 public:
  /// Does not own the descriptors. `stop_descriptor` becomes readable when the server stops.
  ClientSocket(int descriptor, int stop_descriptor, const HttpLimits& limits);

  /// Bytes read, at most `size`; -1 at the end of the stream or of the time for a request.
  std::ptrdiff_t read(char* data, std::size_t size);

  /// Writes all of it; false when the client is gone or too slow.
  bool write(std::string_view text);

  /// Whether the client can still be written to, so far as is known.
  bool is_open() const;

  /// All is written: lets the client take it. What it still sends would otherwise cut its answer off.
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  bool wait_for(short events, std::chrono::milliseconds timeout) const;
  std::ptrdiff_t write_some(std::string_view text);

  int descriptor_;
  int stop_descriptor_;
  HttpLimits limits_;
  Clock::time_point head_deadline_;
  double behind_s_ = 0.0;  // waited for the client, less what its bytes allow
};

}  // namespace geoloc::io
