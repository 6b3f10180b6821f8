// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>

namespace geoloc {

/// Rows by independent errors of variance one, as rows by the first `kept` of them and as few others as have
/// the same covariances.
inline Eigen::MatrixXd with_fewer_errors(const Eigen::MatrixXd& rows, Eigen::Index kept) {
  const Eigen::MatrixXd rest = rows.rightCols(rows.cols() - kept);
  const Eigen::Index others = std::min(rows.rows(), rest.cols());
  Eigen::MatrixXd fewer = Eigen::MatrixXd::Zero(rows.rows(), kept + others);
  fewer.leftCols(kept) = rows.leftCols(kept);
  if (others == 0) return fewer;
  const Eigen::HouseholderQR<Eigen::MatrixXd> root(rest.transpose());
  const Eigen::MatrixXd upper = root.matrixQR().topRows(others).triangularView<Eigen::Upper>();
  fewer.rightCols(others) = upper.transpose();
  return fewer;
}

}  // namespace geoloc
