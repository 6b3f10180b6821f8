// SPDX-License-Identifier: Apache-2.0
#include "calibration/row_kernels.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <vector>

namespace geoloc {
namespace {

constexpr std::size_t kLongest = 40;

class RowKernels : public ::testing::Test {
 protected:
  std::vector<double> row() {
    std::vector<double> row(kLongest + 1);
    for (double& value : row) value = normal_(random_);
    return row;
  }

  static double plain_dot(const double* x, const double* y, std::size_t size) {
    double sum = 0.0;
    for (std::size_t i = 0; i < size; ++i) sum += x[i] * y[i];
    return sum;
  }

  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
};

/// Rows have any length, and begin at any address.
TEST_F(RowKernels, GiveWhatPlainLoopsGive) {
  const std::vector<double> x = row(), y0 = row(), y1 = row(), y2 = row();
  for (std::size_t from = 0; from < 2; ++from) {
    for (std::size_t size = 0; size <= kLongest; ++size) {
      const double* const begin = x.data() + from;
      const std::array<const double*, 3> rows = {y0.data() + from, y1.data() + from, y2.data() + from};
      EXPECT_NEAR(dot_of_rows(begin, rows[0], size), plain_dot(begin, rows[0], size), 1e-12);
      const std::array<double, 3> dots = dots_of_rows(begin, rows, size);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(dots[k], plain_dot(begin, rows[k], size), 1e-12);

      const std::array<double, 3> factors = {0.7, -1.3, 0.2};
      std::vector<double> left = x;
      subtract_rows(left.data() + from, factors, rows, size);
      for (std::size_t i = 0; i <= kLongest; ++i) {
        double expected = x[i];
        for (std::size_t k = 0; k < 3 && i >= from && i < from + size; ++k)
          expected -= factors[k] * rows[k][i - from];
        EXPECT_NEAR(left[i], expected, 1e-12) << i;
      }
    }
  }
}

}  // namespace
}  // namespace geoloc
