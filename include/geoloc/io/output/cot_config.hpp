// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace geoloc::io {

/// How objects become Cursor on Target events (docs/outputs.md).
struct CotConfig {
  std::string uid_prefix = "geoloc";         ///< of every object's uid
  std::string type = "a-u-G";                ///< of objects: unknown, on the ground
  std::map<std::string, std::string> types;  ///< of those of a class, by its name
  double period_s = 10.0;                    ///< an object is sent again so often
  double stale_s = 300.0;                    ///< after its last event it is out of date
  double error_probability = 0.9;            ///< that ce and le hold the object: CE90, as ATAK takes them
  double sigma_height_m = 2.0;               ///< of the ground above sea level, as the autopilot has it
  int multicast_ttl = 1;                     ///< networks that a datagram may cross; 1: our own
  std::string multicast_interface;           ///< by name; empty: the system chooses

  /// Every fault, named by its JSON path; empty where the settings can be used.
  std::vector<std::string> problems() const;
};

}  // namespace geoloc::io
