// SPDX-License-Identifier: Apache-2.0
#include "calibration/envelope_cholesky.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/row_kernels.hpp"
#include "geometry/room.hpp"

namespace geoloc {
namespace {

std::array<const double*, 3> from_column(const EnvelopeCholesky::Rows& rows, Eigen::Index column) {
  return {&rows(0, column), &rows(1, column), &rows(2, column)};
}

}  // namespace

EnvelopeCholesky::EnvelopeCholesky(Eigen::Index max_size) {
  take_room(this, max_size);
  rows_.setZero();
  first_.setZero();
  inverse_diagonal_.setZero();
}

std::size_t EnvelopeCholesky::take_room(EnvelopeCholesky* self, Eigen::Index max_size) {
  return room::resize(self, &EnvelopeCholesky::rows_, max_size, max_size) +
         room::resize(self, &EnvelopeCholesky::first_, max_size) +
         room::resize(self, &EnvelopeCholesky::inverse_diagonal_, max_size);
}

void EnvelopeCholesky::reset(Eigen::Index size) {
  size_ = size;
  rows_.topLeftCorner(size, size).setZero();
  for (Eigen::Index i = 0; i < size; ++i) first_[i] = i;
}

double EnvelopeCholesky::dot(Eigen::Index i, Eigen::Index j, Eigen::Index begin, Eigen::Index end) const {
  if (begin >= end) return 0.0;
  return dot_of_rows(&rows_(i, begin), &rows_(j, begin), static_cast<std::size_t>(end - begin));
}

void EnvelopeCholesky::subtract(Eigen::Index row, Eigen::Index column, const Eigen::Vector3d& factors,
                                const Rows& rows, Eigen::Index size) {
  first_[row] = std::min(first_[row], column);
  subtract_rows(&rows_(row, column), {factors[0], factors[1], factors[2]}, from_column(rows, column),
                static_cast<std::size_t>(size));
}

/// Three columns at a time, so that a row is read once for them, and what was just written not at once.
bool EnvelopeCholesky::factorize() {
  for (Eigen::Index i = 0; i < size_; ++i) {
    const Eigen::Index first = first_[i];
    Eigen::Index j = first;
    for (; j + 3 <= i; j += 3) factorize_three(i, j);
    for (; j < i; ++j)
      rows_(i, j) = (rows_(i, j) - dot(i, j, std::max(first, first_[j]), j)) * inverse_diagonal_[j];
    const double square = rows_(i, i) - dot(i, i, first, i);
    if (!(square > 0.0)) return false;
    rows_(i, i) = std::sqrt(square);
    inverse_diagonal_[i] = 1.0 / rows_(i, i);
  }
  return true;
}

/// Columns j to j + 2 of row i. What the envelopes do not share is zero.
void EnvelopeCholesky::factorize_three(Eigen::Index i, Eigen::Index j) {
  const Eigen::Index begin = std::max(first_[i], std::min(j, first_.segment<3>(j).minCoeff()));
  const auto done =
      dots_of_rows(&rows_(i, begin), {&rows_(j, begin), &rows_(j + 1, begin), &rows_(j + 2, begin)},
                   static_cast<std::size_t>(j - begin));
  double* const here = &rows_(i, j);
  here[0] = (here[0] - done[0]) * inverse_diagonal_[j];
  here[1] = (here[1] - done[1] - here[0] * rows_(j + 1, j)) * inverse_diagonal_[j + 1];
  here[2] = (here[2] - done[2] - here[0] * rows_(j + 2, j) - here[1] * rows_(j + 2, j + 1)) *
            inverse_diagonal_[j + 2];
}

void EnvelopeCholesky::solve_lower(Rows& X, Eigen::Index first) const {
  for (Eigen::Index i = first; i < size_; ++i) {
    const Eigen::Index begin = std::max(first, first_[i]);
    if (begin < i) {
      const auto known =
          dots_of_rows(&rows_(i, begin), from_column(X, begin), static_cast<std::size_t>(i - begin));
      X.col(i) -= Eigen::Vector3d::Map(known.data());
    }
    X.col(i) *= inverse_diagonal_[i];
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
