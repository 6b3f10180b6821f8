// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>

namespace geoloc {

/// Rigid transform, named target_from_source: `enu_from_camera * point_in_camera` is that point in ENU, and
/// adjacent names cancel in `enu_from_body * body_from_camera`.
template <typename Scalar>
struct Rigid3 {
  Eigen::Quaternion<Scalar> rotation = Eigen::Quaternion<Scalar>::Identity();     ///< unit
  Eigen::Matrix<Scalar, 3, 1> translation = Eigen::Matrix<Scalar, 3, 1>::Zero();  ///< [m]

  Rigid3 inverse() const {
    const Eigen::Quaternion<Scalar> back = rotation.conjugate();
    return {back, -(back * translation)};
  }
};

using Rigid3d = Rigid3<double>;

template <typename Scalar>
Rigid3<Scalar> operator*(const Rigid3<Scalar>& c_from_b, const Rigid3<Scalar>& b_from_a) {
  return {(c_from_b.rotation * b_from_a.rotation).normalized(),
          c_from_b.rotation * b_from_a.translation + c_from_b.translation};
}

template <typename Scalar>
Eigen::Matrix<Scalar, 3, 1> operator*(const Rigid3<Scalar>& b_from_a,
                                      const Eigen::Matrix<Scalar, 3, 1>& point_in_a) {
  return b_from_a.rotation * point_in_a + b_from_a.translation;
}

}  // namespace geoloc
