// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "geoloc/io/recording/tlog.hpp"
#include "geoloc/sim/flight/mavlink_frame.hpp"
#include "geoloc/sim/live/recorded_streams.hpp"

namespace geoloc::sim {

/// Collects frames, and puts them in the order of time.
class LogBuilder {
 public:
  void add(HostTime received_at, Datagram frame) { records_.emplace_back(received_at, std::move(frame)); }

  void add(const io::TlogRecord& record) {
    add(record.received_at, Datagram(record.frame, record.frame + record.size));
  }

  void add(HostTime received_at, const FrameView& like, const Payload& payload) {
    add(received_at,
        encode_frame(like.message_id, {like.system_id, like.component_id}, sequence_++, payload));
  }

  io::Tlog build() {
    const auto is_earlier = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::stable_sort(records_.begin(), records_.end(), is_earlier);
    std::vector<std::uint8_t> bytes;
    for (const auto& [received_at, frame] : records_) {
      const auto stamp =
          io::tlog_stamp(std::chrono::round<std::chrono::microseconds>(received_at.time_since_epoch()));
      bytes.insert(bytes.end(), stamp.begin(), stamp.end());
      bytes.insert(bytes.end(), frame.begin(), frame.end());
    }
    return io::Tlog(std::move(bytes));
  }

 private:
  std::vector<std::pair<HostTime, Datagram>> records_;
  std::uint8_t sequence_ = 0;
};

template <typename Fields>
Fields fields_in(const FrameView& frame) {
  const Payload payload = whole_payload(frame);
  Fields fields;
  std::memcpy(&fields, payload.data(), sizeof fields);
  return fields;
}

template <typename Fields>
Payload payload_with(const Fields& fields) {
  Payload payload{};
  std::memcpy(payload.data(), &fields, sizeof fields);
  return payload;
}

}  // namespace geoloc::sim
