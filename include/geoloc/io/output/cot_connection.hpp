// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "geoloc/io/output/cot_config.hpp"

namespace geoloc::io {

class TlsIdentity;
class TlsSession;

enum class CotTransport { kUdp, kTcp, kTls };

struct CotEndpoint {
  CotTransport transport = CotTransport::kUdp;
  std::string host;
  std::string port;
};

/// "udp://HOST:PORT", "tcp://HOST:PORT" or "tls://HOST:PORT"; an IPv6 address in brackets. Throws
/// std::invalid_argument that shows the text.
CotEndpoint parse_cot_endpoint(const std::string& text);

/// A connection to TAK clients (UDP, to one or to a multicast group) or to a TAK server (TCP, plain or with
/// TLS). Apart from name look-ups, poll() and send() do not wait for the network. A failed connection is
/// retried after 1 s, then at growing intervals of up to 30 s, as is a server that accepts nothing, or does
/// not finish its part of a handshake, for 10 s. Why it fails is told once, until a connection has held.
class CotConnection {
 public:
  using Clock = std::chrono::steady_clock;
  using Tell = std::function<void(const std::string& message)>;

  struct Counts {
    std::uint64_t sent = 0;    ///< events given to the network
    std::uint64_t failed = 0;  ///< events that it refused
    std::uint64_t connections = 0;
  };

  /// Throws std::runtime_error naming the setting where a file that TLS needs is not usable.
  CotConnection(CotEndpoint endpoint, const CotConfig& config, Tell tell);
  ~CotConnection();
  CotConnection(const CotConnection&) = delete;
  CotConnection& operator=(const CotConnection&) = delete;

  /// Connects, sends and receives as far as possible without waiting. To be called often.
  void poll(Clock::time_point now);

  /// Whether an event can be accepted now.
  bool is_ready() const;

  /// Only while is_ready().
  void send(const std::string& event);

  /// Waits until everything is sent, or for `timeout`. True if everything was sent.
  bool flush(std::chrono::milliseconds timeout);

  /// Says farewell and waits until the server has done so, or for `timeout`: a connection closed with bytes
  /// unread would take with it what the server has not read yet.
  void end(std::chrono::milliseconds timeout);

  const Counts& counts() const { return counts_; }
  int descriptor() const { return descriptor_; }  ///< -1 while there is none

 private:
  bool is_stream() const { return endpoint_.transport != CotTransport::kUdp; }
  void open(Clock::time_point now);
  void finish_connecting(Clock::time_point now);
  void note_open(Clock::time_point now);
  void set_multicast(int family) const;
  void write_pending(Clock::time_point now);
  void receive(Clock::time_point now);
  bool receive(std::string_view bytes, Clock::time_point now);
  void fail(Clock::time_point now, const std::string& reason);
  std::string name() const;

  CotEndpoint endpoint_;
  CotConfig config_;
  Tell tell_;
  std::unique_ptr<const TlsIdentity> identity_;  // TLS
  std::unique_ptr<TlsSession> session_;          // TLS: of this connection
  int descriptor_ = -1;
  bool is_connecting_ = false;
  bool is_open_ = false;  // for events
  std::string pending_;   // streams: not taken by the system yet
  Clock::time_point connected_at_{};
  Clock::time_point moved_at_{};
  Clock::time_point next_attempt_{};
  std::chrono::seconds backoff_{1};
  bool has_told_ = false;  // that it is out of reach
  Counts counts_;
};

}  // namespace geoloc::io
