// SPDX-License-Identifier: Apache-2.0
#include "geoloc/calibration/drift_config.hpp"

#include "calibration/drift_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc {

std::vector<std::string> DriftConfig::problems() const {
  return check_fields(*this);
}

}  // namespace geoloc
