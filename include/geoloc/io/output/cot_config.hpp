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
  double stale_s = 300.0;
  double error_probability = 0.9;  ///< CE90, as ATAK takes it
  double sigma_height_m = 2.0;     ///< of the ground above sea level
  int multicast_ttl = 1;
  std::string multicast_interface;  ///< by name; empty: the system chooses

  /// Every fault, named by its path; empty where the settings can be used.
  std::vector<std::string> problems() const;
};

}  // namespace geoloc::io
