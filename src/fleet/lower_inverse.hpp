// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace geoloc {

/// L^-1 of a lower triangle, whose upper triangle is not read. Some columns at a time, so that the work on
/// zeros above them is left out.
inline Eigen::MatrixXd inverse_of_lower(const Eigen::MatrixXd& lower) {
  constexpr Eigen::Index kColumns = 96;
  const Eigen::Index size = lower.rows();
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(size, size);
  for (Eigen::Index begin = 0; begin < size; begin += kColumns) {
    const Eigen::Index left = size - begin;
    auto columns = inverse.block(begin, begin, left, std::min(kColumns, left));
    lower.bottomRightCorner(left, left).triangularView<Eigen::Lower>().solveInPlace(columns);
  }
  return inverse;
}

}  // namespace geoloc
