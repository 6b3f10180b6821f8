// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/assignment.hpp"

#include <algorithm>

namespace geoloc {
namespace {

/// A pair that is worse than leaving both alone costs exactly as much: it can be chosen only for nothing, and
/// is then dropped.
double capped_cost(const Eigen::Ref<const Eigen::MatrixXd>& costs, bool transposed, double max_cost, int row,
                   int column) {
  const double cost = transposed ? costs(column, row) : costs(row, column);
  return cost < max_cost ? cost : max_cost;  // NaN gives max_cost
}

}  // namespace

void AssignmentSolver::reserve(int rows, int columns) {
  const int longer = std::max(rows, columns) + 1;
  for (auto* values : {&row_potential_, &column_potential_, &shortest_}) values->reserve(longer);
  for (auto* values : {&row_of_column_, &previous_column_}) values->reserve(longer);
  column_of_row_.reserve(longer);
  visited_.reserve(longer);
}

void AssignmentSolver::augment(const Eigen::Ref<const Eigen::MatrixXd>& costs, bool transposed,
                               double max_cost, int row, int columns) {
  std::fill(shortest_.begin(), shortest_.end(), std::numeric_limits<double>::infinity());
  std::fill(visited_.begin(), visited_.end(), char{0});
  row_of_column_[0] = row;

  int column = 0;
  do {  // Dijkstra over reduced costs, until a free column is reached
    visited_[column] = 1;
    const int from_row = row_of_column_[column];
    double step = std::numeric_limits<double>::infinity();
    int next = 0;
    for (int j = 1; j <= columns; ++j) {
      if (visited_[j] != 0) continue;
      const double reduced = capped_cost(costs, transposed, max_cost, from_row - 1, j - 1) -
                             row_potential_[from_row] - column_potential_[j];
      if (reduced < shortest_[j]) {
        shortest_[j] = reduced;
        previous_column_[j] = column;
      }
      if (shortest_[j] < step) {
        step = shortest_[j];
        next = j;
      }
    }
    for (int j = 0; j <= columns; ++j) {
      if (visited_[j] != 0) {
        row_potential_[row_of_column_[j]] += step;
        column_potential_[j] -= step;
      } else {
        shortest_[j] -= step;
      }
    }
    column = next;
  } while (row_of_column_[column] != 0);

  while (column != 0) {  // turn the path round
    const int previous = previous_column_[column];
    row_of_column_[column] = row_of_column_[previous];
    column = previous;
  }
}

const std::vector<std::size_t>& AssignmentSolver::solve(const Eigen::Ref<const Eigen::MatrixXd>& costs,
                                                        double max_cost) {
  const bool transposed = costs.rows() > costs.cols();
  const int rows = static_cast<int>(transposed ? costs.cols() : costs.rows());
  const int columns = static_cast<int>(transposed ? costs.rows() : costs.cols());
  const int column_slots = columns + 1;  // the first stands for the row being placed
  row_potential_.assign(rows + 1, 0.0);
  column_potential_.assign(column_slots, 0.0);
  shortest_.assign(column_slots, 0.0);
  row_of_column_.assign(column_slots, 0);
  previous_column_.assign(column_slots, 0);
  visited_.assign(column_slots, 0);
  for (int row = 1; row <= rows; ++row) augment(costs, transposed, max_cost, row, columns);

  column_of_row_.assign(costs.rows(), kUnassigned);
  for (int j = 1; j <= columns; ++j) {
    const int i = row_of_column_[j];
    if (i == 0) continue;
    const int row = transposed ? j - 1 : i - 1;
    const int column = transposed ? i - 1 : j - 1;
    if (costs(row, column) < max_cost) column_of_row_[row] = column;
  }
  return column_of_row_;
}

}  // namespace geoloc
