// SPDX-License-Identifier: Apache-2.0
#include "calibration/envelope_cholesky.hpp"

#include <algorithm>
#include <cmath>

namespace geoloc {

EnvelopeCholesky::EnvelopeCholesky(Eigen::Index max_size) {
  rows_.setZero(max_size, max_size);
  first_.setZero(max_size);
  inverse_diagonal_.setZero(max_size);
}

void EnvelopeCholesky::reset(Eigen::Index size) {
  size_ = size;
  rows_.topLeftCorner(size, size).setZero();
  for (Eigen::Index i = 0; i < size; ++i) first_[i] = i;
}

bool EnvelopeCholesky::factorize() {
  for (Eigen::Index i = 0; i < size_; ++i) {
    const Eigen::Index first = first_[i];
    for (Eigen::Index j = first; j < i; ++j) {
      const Eigen::Index begin = std::max(first, first_[j]);
      const double sum = begin < j ? row(i, begin, j).dot(row(j, begin, j)) : 0.0;
      rows_(i, j) = (rows_(i, j) - sum) * inverse_diagonal_[j];
    }
    const double square = rows_(i, i) - row(i, first, i).squaredNorm();
    if (!(square > 0.0)) return false;
    rows_(i, i) = std::sqrt(square);
    inverse_diagonal_[i] = 1.0 / rows_(i, i);
  }
  return true;
}

void EnvelopeCholesky::solve_lower(Eigen::Ref<Columns> X, Eigen::Index first) const {
  for (Eigen::Index i = first; i < size_; ++i) {
    // Two sums that do not wait for each other.
    Eigen::RowVector3d even = X.row(i), odd = Eigen::RowVector3d::Zero();
    Eigen::Index j = std::max(first, first_[i]);
    for (; j + 1 < i; j += 2) {
      even -= rows_(i, j) * X.row(j);
      odd -= rows_(i, j + 1) * X.row(j + 1);
    }
    if (j < i) even -= rows_(i, j) * X.row(j);
    X.row(i) = (even + odd) * inverse_diagonal_[i];
  }
}

void EnvelopeCholesky::solve(Eigen::Ref<Eigen::VectorXd> x) const {
  const auto row_before = [&](Eigen::Index i) {
    const Eigen::Index first = first_[i];
    return rows_.row(i).segment(first, i - first).transpose();
  };
  const auto x_before = [&](Eigen::Index i) {
    const Eigen::Index first = first_[i];
    return x.segment(first, i - first);
  };
  for (Eigen::Index i = 0; i < size_; ++i)
    x[i] = (x[i] - row_before(i).dot(x_before(i))) * inverse_diagonal_[i];
  for (Eigen::Index i = size_ - 1; i >= 0; --i) {
    x[i] *= inverse_diagonal_[i];
    x_before(i) -= x[i] * row_before(i);
  }
}

}  // namespace geoloc
