// SPDX-License-Identifier: Apache-2.0
#include "geoloc/calibration/calibration.hpp"

#include <cmath>

#include "geoloc/geometry/problems.hpp"

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
  Problems found;
  for (const double angle : {boresight_x_deg, boresight_y_deg, boresight_z_deg}) {
    found.require(std::abs(angle) <= 30.0, "joint.prior boresight angles must lie in [-30, 30] deg");
  }
  found.require(std::abs(latency_s) <= 5.0, "joint.prior.latency_s must lie in [-5, 5]");
  found.require(std::abs(height_m) <= 100.0, "joint.prior.height_m must lie in [-100, 100]");
  for (const double sigma : {sigma_boresight_x_deg, sigma_boresight_y_deg, sigma_boresight_z_deg,
                             sigma_latency_s, sigma_height_m}) {
    found.require(sigma >= 0.0 && sigma <= 100.0,
                  "joint.prior sigmas must lie in [0, 100]; 0 freezes a component");
  }
  return found.take();
}

}  // namespace geoloc
