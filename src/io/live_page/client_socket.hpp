// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "http_server.hpp"

namespace geoloc::io {

/// One client's connection, with an end to everything: to what is read, to the time that takes, to the
/// patience with one who does not take what is written, and to all of it once the server stops.
class ClientSocket {
 public:
  /// Does not own the descriptors. `stop_descriptor` becomes readable when the server stops.
  ClientSocket(int descriptor, int stop_descriptor, const HttpLimits& limits);

  /// Bytes read, at most `size`; -1 at the end of the stream or of a limit.
  std::ptrdiff_t read(char* data, std::size_t size);

  /// Bytes taken, at least one; -1 when the client is gone or too slow.
  std::ptrdiff_t write(const char* data, std::size_t size);

  /// Can still be written to, so far as is known.
  bool is_open() const;

  /// All is written: lets the client take it. What it still sends would otherwise cut its answer off.
  void end();

  int descriptor() const { return descriptor_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool wait_for(short events, std::chrono::milliseconds timeout) const;
  bool fill();

  int descriptor_;
  int stop_descriptor_;
  HttpLimits limits_;
  Clock::time_point head_deadline_;
  std::vector<char> buffer_;
  std::size_t next_ = 0;    // in the buffer
  std::size_t filled_ = 0;  // of the buffer
  std::size_t total_read_ = 0;
  double behind_s_ = 0.0;  // waited for the client, less what its bytes allow
};

}  // namespace geoloc::io
