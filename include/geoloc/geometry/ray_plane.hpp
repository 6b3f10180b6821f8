// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

namespace geoloc {

template <typename Scalar>
struct Ray {
  Eigen::Matrix<Scalar, 3, 1> origin;     ///< [m]
  Eigen::Matrix<Scalar, 3, 1> direction;  ///< unit length

  Eigen::Matrix<Scalar, 3, 1> at(Scalar range_m) const { return origin + range_m * direction; }
};

template <typename Scalar>
struct Plane {
  Eigen::Matrix<Scalar, 3, 1> normal;  ///< unit length
  Scalar offset_m;                     ///< normal.dot(point) on the plane
};

/// Range [m] from the ray's origin to the plane (paper, eq. 10); nullopt where the ray is parallel to the
/// plane, leads away from it, or is not finite.
template <typename Scalar>
std::optional<Scalar> intersect(const Ray<Scalar>& ray, const Plane<Scalar>& plane) {
  using std::abs;
  const Scalar sine = plane.normal.dot(ray.direction);
  if (!(abs(sine) > Scalar(1e-9))) return std::nullopt;  // negated, so that NaN fails too
  const Scalar range_m = (plane.offset_m - plane.normal.dot(ray.origin)) / sine;
  if (!(range_m > Scalar(0) && std::isfinite(range_m))) return std::nullopt;
  return range_m;
}

}  // namespace geoloc
