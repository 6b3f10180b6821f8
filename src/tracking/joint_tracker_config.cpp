// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/joint_tracker_config.hpp"

#include "settings/field_checker.hpp"
#include "tracking/joint_tracker_fields.hpp"

namespace geoloc {

std::vector<std::string> MovingConfig::problems() const {
  return check_fields(*this);
}

std::vector<std::string> JointTrackerConfig::problems() const {
  return check_fields(*this);
}

}  // namespace geoloc
