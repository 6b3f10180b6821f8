// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "fuzz/require.hpp"
#include "geoloc/io/fleet/fleet_store.hpp"
#include "geoloc/io/fleet/summary_file.hpp"
#include "geoloc/io/mqtt/mqtt_address.hpp"
#include "geoloc/io/mqtt/summary_inbox.hpp"

namespace geoloc::io::hostile {

/// A message of a topic, its line feed, and a payload: opened, it is a summary of that flight or is counted.
inline void open_any_message(const std::string& content) {
  const std::size_t end = std::min(content.find('\n'), content.size());
  const std::string topic = content.substr(0, end),
                    payload = content.substr(std::min(end + 1, content.size()));
  SummaryInbox inbox("club");
  for (int i = 0; i < 2; ++i) {
    const auto summary = inbox.open(topic, payload);
    const SummaryInbox::Counts& counts = inbox.counts();
    require(counts.taken + counts.repeated + counts.refused == (payload.empty() ? 0U : i + 1U));
    require(summary.has_value() == (i == 0 && counts.taken == 1));
    if (summary)
      require(summary->problems().empty() && flight_of_topic(topic, "club") == summary->identity.flight);
  }
}

/// An address is refused, or read the same from what it says of itself.
inline void read_any_address(const std::string& content) {
  try {
    MqttAddress address = parse_mqtt_address(content);
    address.user.clear();
    const MqttAddress again = parse_mqtt_address(address.url());
    require(again.host == address.host && again.port == address.port && again.fleet == address.fleet);
  } catch (const std::invalid_argument&) {
  }
}

inline void read_any_ids(const std::string& content) {
  try {
    const ObjectIds ids = ids_from_json(content, "any");
    require(ids_from_json(ids_to_json(ids), "again").of == ids.of);
    for (const auto& [flight, objects] : ids.of) {
      for (const auto& [object, id] : objects) require(id > 0 && id < ids.next);
    }
  } catch (const std::runtime_error&) {
  }
}

}  // namespace geoloc::io::hostile
