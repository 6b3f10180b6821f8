// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "common/output_files.hpp"
#include "geoloc/io/mqtt/mqtt_connection.hpp"

namespace geoloc::apps {

/// --mqtt, and how its broker is reached.
struct MqttOptions {
  std::string url;            ///< empty: none
  std::string password_file;  ///< empty: the environment's GEOLOC_MQTT_PASSWORD, where it is set
  std::string ca_file;
  std::string certificate_file;
  std::string key_file;
};

/// `help`: of --mqtt.
void add_mqtt_options(CLI::App& program, MqttOptions& options, const char* help);

/// The files that they read, as inputs for check_outputs().
NamedFiles inputs_of(const MqttOptions& options);

/// Throws std::exception naming the option and what is wrong: an address that is none, a password's file that
/// every user of the computer can read.
io::MqttAccess mqtt_access(const MqttOptions& options);

/// A password that goes over the network unencrypted; empty where none does.
std::string warning_of(const io::MqttAccess& access);

}  // namespace geoloc::apps
