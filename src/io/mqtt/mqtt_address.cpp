// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mqtt/mqtt_address.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <stdexcept>

#include "geoloc/fleet/flight_summary.hpp"
#include "geoloc/io/endpoint.hpp"

namespace geoloc::io {
namespace {

constexpr std::uint16_t kPlainPort = 1883, kTlsPort = 8883;
constexpr std::size_t kMostUser = 128;
constexpr std::string_view kRoot = "geoloc/v1/", kLeaf = "/summary";

[[noreturn]] void refuse(const std::string& reason) {
  throw std::invalid_argument(reason + "; it is mqtt://[USER@]HOST[:PORT]/FLEET, or mqtts:// for TLS");
}

bool is_user(const std::string& user) {
  return user.size() <= kMostUser && std::all_of(user.begin(), user.end(), [](char c) {
           return std::isgraph(static_cast<unsigned char>(c)) != 0;
         });
}

/// Takes what stands before the mark from the text, and the mark; nullopt: it has none.
std::optional<std::string> take_before(char mark, std::string& text) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) return std::nullopt;
  std::string before = text.substr(0, at);
  text.erase(0, at + 1);
  return before;
}

void read_user(std::string& authority, MqttAddress& address) {
  const auto user = take_before('@', authority);
  if (!user) return;
  if (user->find(':') != std::string::npos)
    throw std::invalid_argument(
        "a password does not belong on a command line, where every user of the computer can read it: put "
        "it into a file (--mqtt-password-file) or into the environment (GEOLOC_MQTT_PASSWORD)");
  if (user->empty() || !is_user(*user)) refuse("the user's name is none");
  address.user = *user;
}

}  // namespace

std::string MqttAddress::url() const {
  const bool is_ipv6 = host.find(':') != std::string::npos;
  return std::string(is_tls ? "mqtts://" : "mqtt://") + (is_ipv6 ? "[" + host + "]" : host) + ":" +
         std::to_string(port) + "/" + fleet;
}

MqttAddress parse_mqtt_address(const std::string& url) {
  MqttAddress address;
  std::string rest = url;
  if (rest.rfind("mqtts://", 0) == 0) {
    address.is_tls = true;
    rest.erase(0, 8);
  } else if (rest.rfind("mqtt://", 0) == 0) {
    rest.erase(0, 7);
  } else {
    refuse("the address of a broker begins with mqtt:// or mqtts://");
  }
  auto authority = take_before('/', rest);
  if (!authority) refuse("the fleet is missing");
  address.fleet = rest;
  read_user(*authority, address);
  if (!is_flight_name(address.fleet)) refuse("a fleet's name is 1 to 64 letters, digits, or any of - _ . :");
  const auto default_port = address.is_tls ? kTlsPort : kPlainPort;
  if (const auto host = parse_host(*authority)) {
    address.host = *host;
    address.port = default_port;
  } else if (const auto endpoint = parse_endpoint(*authority); endpoint && endpoint->port != 0) {
    address.host = endpoint->host;
    address.port = endpoint->port;
  } else {
    refuse("the broker's host or port is none");
  }
  return address;
}

std::string summary_topic(std::string_view fleet, std::string_view flight) {
  return std::string(kRoot).append(fleet).append("/").append(flight).append(kLeaf);
}

std::optional<std::string> flight_of_topic(std::string_view topic, std::string_view fleet) {
  const std::string begin = std::string(kRoot).append(fleet).append("/");
  if (topic.size() <= begin.size() + kLeaf.size() || topic.substr(0, begin.size()) != begin ||
      topic.substr(topic.size() - kLeaf.size()) != kLeaf)
    return std::nullopt;
  const std::string_view flight = topic.substr(begin.size(), topic.size() - begin.size() - kLeaf.size());
  if (!is_flight_name(flight)) return std::nullopt;
  return std::string(flight);
}

}  // namespace geoloc::io
