// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/detection/detection_config.hpp"

#include "io/detection/detection_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc::io {

std::vector<std::string> DetectionConfig::problems() const {
  return check_fields(*this);
}

}  // namespace geoloc::io
