// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

#include "http_server.hpp"

namespace geoloc::io {

/// One client's connection, on which nothing lasts for ever: there are limits to the time of a request and to
/// the time that a client takes to read, and everything ends when the server stops.
class ClientSocket {
 public:
  /// Does not own the descriptors. `stop_descriptor` becomes readable when the server stops.
  ClientSocket(int descriptor, int stop_descriptor, const HttpLimits& limits);

  /// Returns the number of bytes read, at most `size`; -1 at the end of the stream or when the time for a
  /// request is over.
  std::ptrdiff_t read(char* data, std::size_t size);

  /// Writes the whole text; false if the client is gone or too slow.
  bool write(std::string_view text);

  /// Whether, as far as is known, the client can still be written to.
  bool is_open() const;

  /// Lets the client receive everything that was written. Data that it still sends would otherwise cut its
  /// answer off.
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  bool wait_for(short events, std::chrono::milliseconds timeout) const;
  std::ptrdiff_t write_some(std::string_view text);

  int descriptor_;
  int stop_descriptor_;
  HttpLimits limits_;
  Clock::time_point head_deadline_;
  double behind_s_ = 0.0;  // time spent waiting for the client, minus what its bytes allow
};

}  // namespace geoloc::io
