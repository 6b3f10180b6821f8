// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

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

/// What costs look like.
struct Kind {
  const char* name;
  double (*cost)(std::mt19937& random, const Eigen::Vector2d& a, const Eigen::Vector2d& b);
};

double uniform_cost(std::mt19937& random, const Eigen::Vector2d&, const Eigen::Vector2d&) {
  return std::uniform_real_distribution<double>(0.0, 1.2 * kMaxCost)(random);
}
double cost_with_ties(std::mt19937& random, const Eigen::Vector2d&, const Eigen::Vector2d&) {
  return std::uniform_int_distribution<int>(0, 4)(random);
}
double distance(std::mt19937&, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return kMaxCost * (a - b).norm();
}
double distance_in_a_gate(std::mt19937&, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return 5.0 * kMaxCost * (a - b).norm();
}
double below_nothing(std::mt19937& random, const Eigen::Vector2d&, const Eigen::Vector2d&) {
  return std::uniform_real_distribution<double>(-5.0, 0.0)(random);
}

/// The least cost by shortest augmenting paths from zero prices, one row after the other; rows <= columns.
double least_cost_by_augmenting_paths(const Eigen::MatrixXd& costs) {
  const Eigen::Index rows = costs.rows(), columns = costs.cols();
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::VectorXd row_price = Eigen::VectorXd::Zero(rows + 1), price = Eigen::VectorXd::Zero(columns + 1);
  std::vector<Eigen::Index> row_of(columns + 1, 0), before(columns + 1, 0);  // from 1; 0: none
  for (Eigen::Index row = 1; row <= rows; ++row) {
    Eigen::VectorXd distance = Eigen::VectorXd::Constant(columns + 1, infinity);
    std::vector<char> is_reached(columns + 1, 0);
    row_of[0] = row;
    Eigen::Index at = 0;
    do {
      is_reached[at] = 1;
      Eigen::Index nearest = 0;
      double step = infinity;
      for (Eigen::Index j = 1; j <= columns; ++j) {
        if (is_reached[j] != 0) continue;
        const double through = costs(row_of[at] - 1, j - 1) - row_price[row_of[at]] - price[j];
        if (through < distance[j]) {
          distance[j] = through;
          before[j] = at;
        }
        if (distance[j] < step) {
          step = distance[j];
          nearest = j;
        }
      }
      for (Eigen::Index j = 0; j <= columns; ++j) {
        if (is_reached[j] != 0) {
          row_price[row_of[j]] += step;
          price[j] -= step;
        } else {
          distance[j] -= step;
        }
      }
      at = nearest;
    } while (row_of[at] != 0);
    for (; at != 0; at = before[at]) row_of[at] = row_of[before[at]];
  }
  double sum = 0.0;
  for (Eigen::Index j = 1; j <= columns; ++j)
    if (row_of[j] != 0) sum += costs(row_of[j] - 1, j - 1);
  return sum;
}

class AssignmentOfManyKinds : public ::testing::TestWithParam<Kind> {};

TEST_P(AssignmentOfManyKinds, CostIsThatOfAugmentingPathsWithoutReductions) {
  AssignmentSolver solver;  // one for all sizes: what a problem leaves behind must not reach the next
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  const auto places = [&](int count) {
    std::vector<Eigen::Vector2d> drawn;
    for (int i = 0; i < count; ++i) drawn.emplace_back(uniform(random), uniform(random));
    return drawn;
  };
  for (const auto& [rows, columns] : {Shape{40, 40}, Shape{80, 17}, Shape{16, 64}, Shape{33, 31},
                                      Shape{1, 50}, Shape{50, 2}, Shape{100, 100}, Shape{15, 16}}) {
    const auto from = places(rows), to = places(columns);
    Eigen::MatrixXd costs(rows, columns);
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) costs(i, j) = GetParam().cost(random, from[i], to[j]);
    Eigen::MatrixXd limited = costs.cwiseMin(kMaxCost);
    if (rows > columns) limited.transposeInPlace();
    const double left_over = kMaxCost * std::max(0, rows - columns);
    EXPECT_NEAR(cost_of(costs, solver.solve(costs, kMaxCost)),
                least_cost_by_augmenting_paths(limited) + left_over, 1e-9)
        << rows << " x " << columns;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, AssignmentOfManyKinds,
                         ::testing::Values(Kind{"Uniform", uniform_cost}, Kind{"Ties", cost_with_ties},
                                           Kind{"Distances", distance},
                                           Kind{"DistancesInAGate", distance_in_a_gate},
                                           Kind{"BelowNothing", below_nothing}),
                         [](const auto& kind) { return std::string(kind.param.name); });

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
