// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace geoloc::io {

/// Where a fleet meets: mqtt://[USER@]HOST[:PORT]/FLEET, or mqtts:// for TLS.
struct MqttAddress {
  bool is_tls = false;
  std::string user;  ///< empty: none
  std::string host;  ///< address or name, without brackets
  std::uint16_t port = 0;
  std::string fleet;

  /// Without the user, for messages.
  std::string url() const;
};

/// Throws std::invalid_argument that says what is wrong with it: among others, a password, which every user
/// of the computer could read.
MqttAddress parse_mqtt_address(const std::string& url);

/// geoloc/v1/FLEET/FLIGHT/summary. FLIGHT is + for a subscription to all flights.
std::string summary_topic(std::string_view fleet, std::string_view flight);

/// The flight whose summaries the fleet's topic is for; nullopt where it is another topic.
std::optional<std::string> flight_of_topic(std::string_view topic, std::string_view fleet);

}  // namespace geoloc::io
