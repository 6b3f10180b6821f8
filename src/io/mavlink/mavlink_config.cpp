// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/mavlink_config.hpp"

#include "io/mavlink/mavlink_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc::io {

std::vector<std::string> MavlinkConfig::problems() const {
  return check_fields(*this);
}

}  // namespace geoloc::io
