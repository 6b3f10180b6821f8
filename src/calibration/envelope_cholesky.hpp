// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>

namespace geoloc {

/// Cholesky factor of a symmetric positive definite matrix whose rows are zero up to some column. The factor
/// is zero in the same places, its envelope, so that none of the work is done there (George and Liu,
/// Computer Solution of Large Sparse Positive Definite Systems, 1981, chapter 4). Allocates when constructed
/// only.
class EnvelopeCholesky {
 public:
  using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;

  explicit EnvelopeCholesky(Eigen::Index max_size);
  /// geometry/room.hpp
  static std::size_t take_room(EnvelopeCholesky* self, Eigen::Index max_size);

  /// A matrix of zeros to be added to, with an empty envelope. size: at most max_size.
  void reset(Eigen::Index size);

  /// A block in or below the diagonal, taken into the envelope. Where it crosses the diagonal, what is above
  /// is not read.
  template <int Rows, int Columns>
  auto block(Eigen::Index row, Eigen::Index column) {
    for (Eigen::Index r = row; r < row + Rows; ++r) first_[r] = std::min(first_[r], column);
    return rows_.block<Rows, Columns>(row, column);
  }

  /// Subtracts a sum of three rows from one, in `size` columns from `column` up to the diagonal at most.
  void subtract(Eigen::Index row, Eigen::Index column, const Eigen::Vector3d& factors, const Rows& rows,
                Eigen::Index size);

  /// S = L L', in place. False where S is not positive definite.
  [[nodiscard]] bool factorize();

  /// x = S^-1 x after factorize().
  void solve(Eigen::Ref<Eigen::VectorXd> x) const;

  /// X' = L^-1 X' after factorize(), for an X whose columns before `first` are zero. Columns that the matrix
  /// has not are left alone.
  void solve_lower(Rows& X, Eigen::Index first) const;

  /// The last N rows and columns of S^-1 after factorize().
  template <int N>
  Eigen::Matrix<double, N, N> last_of_inverse() const {
    Eigen::Matrix<double, N, N> inverse = Eigen::Matrix<double, N, N>::Identity();
    rows_.block<N, N>(size_ - N, size_ - N).template triangularView<Eigen::Lower>().solveInPlace(inverse);
    return inverse.transpose() * inverse;
  }

  Eigen::Index size() const { return size_; }

 private:
  void factorize_three(Eigen::Index i, Eigen::Index j);

  /// Scalar product of two rows, from column `begin` to `end`.
  double dot(Eigen::Index i, Eigen::Index j, Eigen::Index begin, Eigen::Index end) const;

  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows_;
  /// Column of the first element of each row that may not be zero.
  Eigen::Matrix<Eigen::Index, Eigen::Dynamic, 1> first_;
  Eigen::VectorXd inverse_diagonal_;
  Eigen::Index size_ = 0;
};

}  // namespace geoloc
