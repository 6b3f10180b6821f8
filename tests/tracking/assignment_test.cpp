// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace geoloc {
namespace {

constexpr double kMaxCost = 3.0;
constexpr std::size_t kAlone = AssignmentSolver::kUnassigned;

double capped(double cost) {
  return cost < kMaxCost ? cost : kMaxCost;
}

/// Cost of the best assignment by trying all, a row left alone counting kMaxCost.
double brute_force(const Eigen::MatrixXd& costs, Eigen::Index row, std::vector<char>& taken) {
  if (row == costs.rows()) return 0.0;
  double best = kMaxCost + brute_force(costs, row + 1, taken);
  for (Eigen::Index column = 0; column < costs.cols(); ++column) {
    char& used = taken[static_cast<std::size_t>(column)];
    if (used != 0 || !(costs(row, column) < kMaxCost)) continue;
    used = 1;
    best = std::min(best, costs(row, column) + brute_force(costs, row + 1, taken));
    used = 0;
  }
  return best;
}

double cost_of(const Eigen::MatrixXd& costs, const std::vector<std::size_t>& column_of_row) {
  double sum = 0.0;
  for (Eigen::Index row = 0; row < costs.rows(); ++row) {
    const std::size_t column = column_of_row[static_cast<std::size_t>(row)];
    sum += column == kAlone ? kMaxCost : capped(costs(row, static_cast<Eigen::Index>(column)));
  }
  return sum;
}

struct Shape {
  int rows, columns;
};

class AssignmentLaws : public ::testing::TestWithParam<Shape> {};

TEST_P(AssignmentLaws, CostIsThatOfBruteForce) {
  const auto [rows, columns] = GetParam();
  std::mt19937 random(static_cast<unsigned>(100 * rows + columns));
  std::uniform_real_distribution<double> uniform(0.0, 4.5);  // a third of the pairs lies beyond the limit
  AssignmentSolver solver;
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::MatrixXd costs(rows, columns);
    for (double& cost : costs.reshaped())
      cost = trial % 2 == 0 ? uniform(random) : std::floor(uniform(random));
    std::vector<char> taken(static_cast<std::size_t>(columns), 0);
    const auto& result = solver.solve(costs, kMaxCost);
    EXPECT_NEAR(cost_of(costs, result), brute_force(costs, 0, taken), 1e-9);
  }
}

TEST_P(AssignmentLaws, NoColumnIsGivenTwiceAndNoneBeyondTheLimit) {
  const auto [rows, columns] = GetParam();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 6.0);
  Eigen::MatrixXd costs(rows, columns);
  for (double& cost : costs.reshaped()) cost = uniform(random);
  AssignmentSolver solver;
  std::vector<int> count(static_cast<std::size_t>(columns), 0);
  const auto& result = solver.solve(costs, kMaxCost);
  ASSERT_EQ(result.size(), static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    const std::size_t column = result[static_cast<std::size_t>(row)];
    if (column == kAlone) continue;
    EXPECT_LT(costs(row, static_cast<Eigen::Index>(column)), kMaxCost);
    EXPECT_EQ(++count[column], 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, AssignmentLaws,
                         ::testing::Values(Shape{1, 1}, Shape{1, 6}, Shape{6, 1}, Shape{4, 4}, Shape{3, 6},
                                           Shape{6, 3}, Shape{6, 6}, Shape{5, 7}),
                         [](const auto& shape) {
                           return std::to_string(shape.param.rows) + "x" +
                                  std::to_string(shape.param.columns);
                         });

TEST(Assignment, AnswersEmptyProblems) {
  AssignmentSolver solver;
  EXPECT_TRUE(solver.solve(Eigen::MatrixXd(0, 5), kMaxCost).empty());
  EXPECT_EQ(solver.solve(Eigen::MatrixXd(2, 0), kMaxCost), (std::vector<std::size_t>{kAlone, kAlone}));
}

TEST(Assignment, NeverPairsWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd costs(2, 2);
  costs << nan, 1.0, nan, std::numeric_limits<double>::infinity();
  AssignmentSolver solver;
  EXPECT_EQ(solver.solve(costs, kMaxCost), (std::vector<std::size_t>{1, kAlone}));
}

TEST(Assignment, PrefersTheGlobalOptimumToTheGreedyOne) {
  Eigen::MatrixXd costs(2, 2);
  costs << 0.1, 0.2,  //
      0.2, 2.9;       // greedy would pair 0-0 and pay 3.0
  AssignmentSolver solver;
  EXPECT_EQ(solver.solve(costs, kMaxCost), (std::vector<std::size_t>{1, 0}));
}

}  // namespace
}  // namespace geoloc
