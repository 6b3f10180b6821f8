// SPDX-License-Identifier: Apache-2.0
#include "calibration/envelope_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace geoloc {
namespace {

constexpr int kBlock = 3;
constexpr int kRows = EnvelopeCholesky::Rows::RowsAtCompileTime;

/// Positive definite, made of blocks of which most are zero, and the same as it is built up in `sparse`.
Eigen::MatrixXd random_matrix(int blocks, std::mt19937& random, EnvelopeCholesky& sparse) {
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::uniform_int_distribution<int> earlier(0, blocks - 1);
  const Eigen::Index size = kBlock * blocks;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  sparse.reset(size);
  const auto add = [&](Eigen::Index row, Eigen::Index column, const Eigen::Matrix3d& terms) {
    dense.block<kBlock, kBlock>(row, column) += terms;
    if (row != column) dense.block<kBlock, kBlock>(column, row) += terms.transpose();
    sparse.block<kBlock, kBlock>(row, column) += terms;
  };
  for (int i = 0; i < blocks; ++i) {
    // B B' of a block of rows that touches i and one block before: definite together with the diagonal.
    const int k = std::min(i, earlier(random));
    const auto draw = [&] { return Eigen::Matrix3d::NullaryExpr([&] { return value(random); }).eval(); };
    const Eigen::Matrix3d here = draw(), there = draw();
    add(kBlock * i, kBlock * i, here * here.transpose() + 0.1 * Eigen::Matrix3d::Identity());
    if (k == i) continue;
    add(kBlock * k, kBlock * k, there * there.transpose());
    add(kBlock * i, kBlock * k, here * there.transpose());
  }
  return dense;
}

TEST(EnvelopeCholesky, SolvesAsADenseFactorDoes) {
  std::mt19937 random(3);
  EnvelopeCholesky sparse(kBlock * 20);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXd matrix = random_matrix(1 + trial % 20, random, sparse);
    const Eigen::LLT<Eigen::MatrixXd> dense(matrix);
    ASSERT_TRUE(sparse.factorize());

    Eigen::VectorXd x = Eigen::VectorXd::Random(matrix.rows());
    const Eigen::VectorXd expected = dense.solve(x);
    sparse.solve(x);
    EXPECT_LT((x - expected).norm(), 1e-9 * (1.0 + expected.norm()));

    const Eigen::Index first = matrix.rows() / 2;
    EnvelopeCholesky::Rows rows = EnvelopeCholesky::Rows::Zero(kRows, matrix.rows() + 2);
    rows.rightCols(matrix.rows() + 2 - first).setRandom();
    const EnvelopeCholesky::Rows given = rows;
    const Eigen::MatrixXd expected_rows =
        dense.matrixL().solve(given.leftCols(matrix.rows()).transpose()).transpose();
    sparse.solve_lower(rows, first);
    EXPECT_LT((rows.leftCols(matrix.rows()) - expected_rows).norm(), 1e-9 * (1.0 + expected_rows.norm()));
    EXPECT_EQ(rows.rightCols<2>(), given.rightCols<2>());

    const Eigen::MatrixXd inverse = matrix.inverse();
    EXPECT_LT((sparse.last_of_inverse<kBlock>() - inverse.bottomRightCorner<kBlock, kBlock>()).norm(),
              1e-9 * inverse.norm());
  }
}

TEST(EnvelopeCholesky, RefusesWhatIsNotPositiveDefinite) {
  EnvelopeCholesky matrix(6);
  for (const double diagonal : {0.0, -1.0, std::nan("")}) {
    matrix.reset(6);
    matrix.block<3, 3>(0, 0).setIdentity();
    matrix.block<3, 3>(3, 3).diagonal().setConstant(diagonal);
    EXPECT_FALSE(matrix.factorize()) << diagonal;
  }
}

}  // namespace
}  // namespace geoloc
