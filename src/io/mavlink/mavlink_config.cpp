// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/mavlink_config.hpp"

#include "geoloc/geometry/problems.hpp"

namespace geoloc::io {

std::vector<std::string> MavlinkConfig::problems() const {
  Problems found;
  found.require(system_id >= 0 && system_id <= 255, "mavlink.system_id must lie in [0, 255]");
  found.require(component_id >= 2 && component_id <= 255,
                "mavlink.component_id must lie in [2, 255]: 1 is the autopilot");
  found.require(attitude_rate_hz >= 1.0 && attitude_rate_hz <= 50.0,
                "mavlink.attitude_rate_hz must lie in [1, 50]");
  found.require(position_rate_hz >= 1.0 && position_rate_hz <= 50.0,
                "mavlink.position_rate_hz must lie in [1, 50]");
  found.require(link_timeout_s >= 0.5 && link_timeout_s <= 60.0,
                "mavlink.link_timeout_s must lie in [0.5, 60]");
  found.require(camera_component_id >= 100 && camera_component_id <= 105,
                "mavlink.camera_component_id must lie in [100, 105]");
  return found.take();
}

}  // namespace geoloc::io
