// SPDX-License-Identifier: Apache-2.0
#include "geoloc/calibration/calibration.hpp"

#include <cmath>

#include "calibration/calibration_fields.hpp"
#include "settings/field_checker.hpp"

namespace geoloc {

void Calibration::turn(Rigid3d& enu_from_camera) const {
  const Eigen::Vector3d boresight = boresight_rad();
  const double angle = boresight.norm();
  if (!(angle > 0.0)) return;
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(angle, boresight / angle));
  enu_from_camera.rotation = (enu_from_camera.rotation * rotation).normalized();
}

std::vector<std::string> CalibrationPrior::problems() const {
  return check_fields(*this);
}

}  // namespace geoloc
