// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace geoloc {

/// The symmetric part: what rounding left unsymmetric is taken out.
inline Eigen::Matrix3d symmetric(const Eigen::Matrix3d& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

}  // namespace geoloc
