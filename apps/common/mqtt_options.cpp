// SPDX-License-Identifier: Apache-2.0
#include "common/mqtt_options.hpp"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "geoloc/io/endpoint.hpp"
#include "geoloc/io/text_file.hpp"

namespace geoloc::apps {
namespace {

constexpr std::size_t kLargestPassword = 4096;

std::string password_of(const std::string& file) {
  if (file.empty()) {
    const char* const told = std::getenv("GEOLOC_MQTT_PASSWORD");
    return told == nullptr ? "" : told;
  }
  std::string text = io::read_text_file(file, kLargestPassword);
  using std::filesystem::perms;
  if ((std::filesystem::status(file).permissions() & (perms::others_read | perms::others_write)) !=
      perms::none)
    throw std::runtime_error(file + ": every user of this computer can read it; chmod 600 " + file);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  if (text.empty()) throw std::runtime_error(file + ": is empty");
  return text;
}

}  // namespace

void add_mqtt_options(CLI::App& program, MqttOptions& options, const char* help) {
  CLI::Option* const mqtt = program.add_option("--mqtt", options.url, help);
  mqtt->type_name("URL")->group("Fleet");
  const auto add = [&](const char* name, std::string& file, const char* text) {
    return program.add_option(name, file, text)->type_name("FILE")->needs(mqtt)->group("Fleet");
  };
  add("--mqtt-password-file", options.password_file,
      "Password of the URL's user [the environment's GEOLOC_MQTT_PASSWORD]");
  add("--mqtt-ca", options.ca_file, "Authorities that mqtts:// trusts, PEM [the system's]");
  CLI::Option* const certificate =
      add("--mqtt-cert", options.certificate_file, "Our certificate for mqtts://, PEM");
  add("--mqtt-key", options.key_file, "Its key, PEM, without a password")->needs(certificate);
}

NamedFiles inputs_of(const MqttOptions& options) {
  NamedFiles files;
  add_named(files, "--mqtt-password-file", options.password_file);
  add_named(files, "--mqtt-ca", options.ca_file);
  add_named(files, "--mqtt-cert", options.certificate_file);
  add_named(files, "--mqtt-key", options.key_file);
  return files;
}

io::MqttAccess mqtt_access(const MqttOptions& options) {
  io::MqttAccess access;
  try {
    access.address = io::parse_mqtt_address(options.url);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(std::string("--mqtt: ") + error.what());
  }
  const bool has_tls_file = !options.ca_file.empty() || !options.certificate_file.empty();
  if (has_tls_file && !access.address.is_tls)
    throw std::runtime_error("--mqtt-ca and --mqtt-cert are for mqtts://, and --mqtt is not encrypted");
  if (!options.password_file.empty() && access.address.user.empty())
    throw std::runtime_error("--mqtt-password-file: name the user, too: --mqtt mqtts://USER@HOST/FLEET");
  if (!access.address.user.empty()) {
    try {
      access.password = password_of(options.password_file);
    } catch (const std::exception& error) {
      throw std::runtime_error(std::string("--mqtt-password-file ") + error.what());
    }
  }
  access.ca_file = options.ca_file;
  access.certificate_file = options.certificate_file;
  access.key_file = options.key_file;
  return access;
}

std::string warning_of(const io::MqttAccess& access) {
  const bool is_exposed =
      !access.password.empty() && !access.address.is_tls && !io::is_loopback(access.address.host);
  return is_exposed
             ? "WARNING: --mqtt sends its password and all positions over the network unencrypted; mqtts:// "
               "encrypts them"
             : "";
}

}  // namespace geoloc::apps
