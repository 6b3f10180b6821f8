// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "geoloc/io/mqtt/mqtt_address.hpp"

namespace geoloc::io {

/// How a broker is reached.
struct MqttAccess {
  MqttAddress address;
  std::string password;          ///< of the address' user; empty: none
  std::string ca_file;           ///< PEM, of the authorities that brokers are trusted by; empty: the system's
  std::string certificate_file;  ///< PEM, ours; empty: none
  std::string key_file;          ///< PEM, of our certificate
};

/// A connection to a broker that is taken up again whenever it breaks. It has no thread: all happens while
/// poll() runs, of one thread. What is to be published stands in for what came before and is not yet sent, so
/// that nothing piles up while the broker is away.
class MqttConnection {
 public:
  /// Shows a message to the user.
  using Tell = std::function<void(const std::string& message)>;
  using OnMessage = std::function<void(std::string_view topic, std::string_view payload)>;

  struct Counts {
    std::uint64_t connections = 0;
    std::uint64_t delivered = 0;  ///< the broker has them
    std::uint64_t replaced = 0;   ///< by a newer one before they could be sent
  };

  /// Throws std::runtime_error where files cannot be used, or this build has no MQTT.
  MqttConnection(MqttAccess access, Tell tell);
  ~MqttConnection();
  MqttConnection(const MqttConnection&) = delete;
  MqttConnection& operator=(const MqttConnection&) = delete;

  /// From now on, over all connections: at least once, retained ones first. Before the first poll().
  void subscribe(std::string topics, OnMessage on_message);

  /// Retained, at least once; in place of a payload that waits.
  void publish(const std::string& topic, std::string payload);

  /// Connects, sends and receives for so long at most, or until something happens. A name that is looked up
  /// may take longer.
  void poll(std::chrono::milliseconds patience);

  /// Polls until the broker has all that was published; false where it has not by then.
  bool flush(std::chrono::milliseconds patience);

  bool is_connected() const;
  const Counts& counts() const;
  /// What last went wrong; empty while all is well.
  const std::string& fault() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace geoloc::io
