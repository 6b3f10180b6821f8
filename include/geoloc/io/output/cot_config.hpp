// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace geoloc::io {

/// How objects become Cursor on Target events (docs/outputs.md).
struct CotConfig {
  std::string uid_prefix = "geoloc";
  std::string type = "a-u-G";                ///< unknown, on the ground
  std::map<std::string, std::string> types;  ///< by class name
  double period_s = 10.0;
  double sensor_period_s = 0.0;  ///< of the vehicle and what its camera sees; 0: they are not sent
  std::string vehicle_type = "a-f-A-M-H-Q";  ///< friendly, in the air, a rotary-wing drone
  double stale_s = 300.0;
  double error_probability = 0.9;  ///< CE90, as ATAK takes it
  double sigma_height_m = 2.0;     ///< of the ground above sea level
  int multicast_ttl = 1;
  std::string multicast_interface;  ///< by name; empty: the system chooses
  std::string tls_ca_file;          ///< of the authorities that servers are trusted by; empty: the system's
  std::string tls_client_file;      ///< of our certificate and its key; empty: none
  std::string tls_key_file;         ///< of the key, where that file lacks it
  std::string tls_password_file;    ///< of the password of these files; empty: they have none
  std::string tls_server_name;      ///< for which the server has its certificate; empty: the host of --cot

  /// Every fault, named by its path; empty where the settings can be used.
  std::vector<std::string> problems() const;
};

}  // namespace geoloc::io
