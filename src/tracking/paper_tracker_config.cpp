// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/paper_tracker_config.hpp"

#include "settings/field_checker.hpp"
#include "tracking/paper_tracker_fields.hpp"

namespace geoloc {

std::vector<std::string> PaperTrackerConfig::problems() const {
  return check_fields(*this);
}

}  // namespace geoloc
