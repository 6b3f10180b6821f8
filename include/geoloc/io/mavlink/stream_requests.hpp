// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/rate_meter.hpp"

namespace geoloc::io {

/// A message that the vehicle is to send regularly.
struct WantedStream {
  std::uint32_t message_id = 0;
  double rate_hz = 1.0;
  std::uint8_t data_stream = 0;  ///< MAV_DATA_STREAM that carries it on old autopilots; 0: none
};

struct StreamRequest {
  enum class Method { kMessageInterval, kDataStream };
  WantedStream stream;
  Method method = Method::kMessageInterval;
};

/// Decides what to request from the vehicle, and when. Only arrivals count: a message that arrives often
/// enough, whoever requested it, is not requested, and one that does not is requested again at growing
/// intervals. The answers only set the pace, because they do not say which message they refer to; therefore
/// only one request is open at a time.
class StreamRequests {
 public:
  struct Counts {
    std::uint64_t requests = 0;
    std::uint64_t denials = 0;
  };

  /// Wants these streams from now on, after observing for one second what arrives unrequested. One that was
  /// wanted more often is asked for once in any case, so that it comes as seldom as it is wanted now.
  void want(const std::vector<WantedStream>& streams, HostTime now);

  /// The vehicle rebooted or was out of reach: everything observed before is void.
  void restart(HostTime now);

  void on_message(std::uint32_t message_id, HostTime received_at);

  /// COMMAND_ACK of a MAV_CMD_SET_MESSAGE_INTERVAL.
  void on_answer(std::uint8_t result, HostTime received_at);

  /// The request to send now, if there is one.
  std::optional<StreamRequest> next(HostTime now);

  const Counts& counts() const { return counts_; }

 private:
  enum class Answer { kNone, kGranted, kDenied, kCommandUnknown };

  struct Stream {
    WantedStream wanted;
    RateMeter meter;
    HostTime next_look;
    int attempts = 0;  ///< in a row, without the wanted rate
    Answer answer = Answer::kNone;
    bool is_to_slow_down = false;  ///< it was wanted more often, and has not been answered since
  };

  bool was_wanted_more(const WantedStream& wanted) const;
  static StreamRequest::Method method_for(const Stream& stream);
  StreamRequest ask(Stream& stream, HostTime now);

  std::vector<Stream> streams_;
  std::optional<std::size_t> open_;  ///< the stream whose request awaits its answer
  HostTime open_until_{};
  Counts counts_;
};

}  // namespace geoloc::io
