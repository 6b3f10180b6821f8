// SPDX-License-Identifier: Apache-2.0
#include "rotated_box.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace geoloc::io {
namespace {

/// Second moments of a uniform distribution over the box.
Eigen::Matrix2d covariance(const RotatedBox& box) {
  const double cosine = std::cos(box.angle_rad), sine = std::sin(box.angle_rad);
  Eigen::Matrix2d rotation;
  rotation << cosine, -sine, sine, cosine;
  const Eigen::Vector2d variances{box.width * box.width / 12.0, box.height * box.height / 12.0};
  return rotation * variances.asDiagonal() * rotation.transpose();
}

}  // namespace

Box upright_around(const RotatedBox& box) {
  const double cosine = std::abs(std::cos(box.angle_rad)), sine = std::abs(std::sin(box.angle_rad));
  const double width = box.width * cosine + box.height * sine;
  const double height = box.width * sine + box.height * cosine;
  return {box.centre_x - 0.5 * width, box.centre_y - 0.5 * height, width, height};
}

double probabilistic_overlap(const RotatedBox& a, const RotatedBox& b) {
  const Eigen::Matrix2d of_a = covariance(a), of_b = covariance(b);
  const Eigen::Matrix2d mean = 0.5 * (of_a + of_b);
  const Eigen::Vector2d apart{a.centre_x - b.centre_x, a.centre_y - b.centre_y};
  const double bhattacharyya =
      apart.dot(mean.inverse() * apart) / 8.0 +
      0.5 * std::log(mean.determinant() / std::sqrt(of_a.determinant() * of_b.determinant()));
  const double overlap = 1.0 - std::sqrt(1.0 - std::exp(-std::max(bhattacharyya, 0.0)));
  return std::isfinite(overlap) ? overlap : 0.0;
}

}  // namespace geoloc::io
