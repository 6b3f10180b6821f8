// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/io/mavlink/messages.hpp"
#include "geoloc/sim/flight/flight.hpp"

namespace geoloc::sim {

/// Gives take(received_at, message) everything that the flight's log tells, in its order.
template <typename Take>
void hear_messages(const Flight& flight, const Take& take) {
  io::FrameParser parser;
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    parser.append(record.frame, record.size);
    while (const auto frame = parser.next()) take(record.received_at, io::decode(*frame));
  }
}

/// All messages of one kind, and when they came.
template <typename Content>
struct Heard {
  HostTime at;
  Content message;
};

template <typename Content>
std::vector<Heard<Content>> hear(const Flight& flight) {
  std::vector<Heard<Content>> heard;
  hear_messages(flight, [&](HostTime at, const io::Message& message) {
    if (const auto* content = std::get_if<Content>(&message)) heard.push_back({at, *content});
  });
  return heard;
}

}  // namespace geoloc::sim
