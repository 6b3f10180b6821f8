// SPDX-License-Identifier: Apache-2.0
#include "geoloc/calibration/calibration.hpp"

#include <cmath>

#include "calibration/calibration_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc {

void Calibration::apply_to(Rigid3d& enu_from_camera) const {
  const Eigen::Vector3d turn = boresight_rad();
  const double angle = turn.norm();
  if (angle > 0.0) {
    const Eigen::Quaterniond rotation(Eigen::AngleAxisd(angle, turn / angle));
    enu_from_camera.rotation = (enu_from_camera.rotation * rotation).normalized();
  }
  enu_from_camera.translation.z() += height_m();
}

std::vector<std::string> CalibrationPrior::problems() const {
  return check_fields(*this);
}

}  // namespace geoloc
