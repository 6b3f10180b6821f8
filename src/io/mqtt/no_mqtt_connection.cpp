// SPDX-License-Identifier: Apache-2.0
// Builds without libmosquitto.
#include <stdexcept>

#include "geoloc/io/mqtt/mqtt_connection.hpp"

namespace geoloc::io {

struct MqttConnection::State {
  Counts counts;
  std::string fault;
};

MqttConnection::MqttConnection(MqttAccess /*access*/, Tell /*tell*/) {
  throw std::runtime_error(
      "--mqtt: this geoloc was built without MQTT; build it with Debian's libmosquitto-dev");
}
MqttConnection::~MqttConnection() = default;
void MqttConnection::subscribe(std::string /*topics*/, OnMessage /*on_message*/) {}
void MqttConnection::publish(const std::string& /*topic*/, std::string /*payload*/) {}
void MqttConnection::poll(std::chrono::milliseconds /*patience*/) {}
bool MqttConnection::flush(std::chrono::milliseconds /*patience*/) {
  return false;
}
bool MqttConnection::is_connected() const {
  return false;
}
const MqttConnection::Counts& MqttConnection::counts() const {
  return state_->counts;
}
const std::string& MqttConnection::fault() const {
  return state_->fault;
}

}  // namespace geoloc::io
