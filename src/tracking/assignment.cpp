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
  const auto longer = static_cast<std::size_t>(std::max(rows, columns)) + 1;
  for (auto* values : {&row_potential_, &column_potential_, &shortest_}) values->reserve(longer);
  for (auto* values : {&row_of_column_, &previous_column_, &column_of_row_}) values->reserve(longer);
  visited_.reserve(longer);
}

void AssignmentSolver::augment(const Eigen::Ref<const Eigen::MatrixXd>& costs, bool transposed,
                               double max_cost, int row, int columns) {
  const auto at = [](auto& values, int i) -> decltype(auto) { return values[static_cast<std::size_t>(i)]; };
  std::fill(shortest_.begin(), shortest_.end(), std::numeric_limits<double>::infinity());
  std::fill(visited_.begin(), visited_.end(), char{0});
  at(row_of_column_, 0) = row;

  int column = 0;
  do {  // Dijkstra over reduced costs, until a free column is reached
    at(visited_, column) = 1;
    const int from_row = at(row_of_column_, column);
    double step = std::numeric_limits<double>::infinity();
    int next = 0;
    for (int j = 1; j <= columns; ++j) {
      if (at(visited_, j) != 0) continue;
      const double reduced = capped_cost(costs, transposed, max_cost, from_row - 1, j - 1) -
                             at(row_potential_, from_row) - at(column_potential_, j);
      if (reduced < at(shortest_, j)) {
        at(shortest_, j) = reduced;
        at(previous_column_, j) = column;
      }
      if (at(shortest_, j) < step) {
        step = at(shortest_, j);
        next = j;
      }
    }
    for (int j = 0; j <= columns; ++j) {
      if (at(visited_, j) != 0) {
        at(row_potential_, at(row_of_column_, j)) += step;
        at(column_potential_, j) -= step;
      } else {
        at(shortest_, j) -= step;
      }
    }
    column = next;
  } while (at(row_of_column_, column) != 0);

  while (column != 0) {  // turn the path round
    const int previous = at(previous_column_, column);
    at(row_of_column_, column) = at(row_of_column_, previous);
    column = previous;
  }
}

const std::vector<int>& AssignmentSolver::solve(const Eigen::Ref<const Eigen::MatrixXd>& costs,
                                                double max_cost) {
  const bool transposed = costs.rows() > costs.cols();
  const int rows = static_cast<int>(transposed ? costs.cols() : costs.rows());
  const int columns = static_cast<int>(transposed ? costs.rows() : costs.cols());
  const auto row_slots = static_cast<std::size_t>(rows) + 1;
  const auto column_slots = static_cast<std::size_t>(columns) + 1;
  row_potential_.assign(row_slots, 0.0);
  column_potential_.assign(column_slots, 0.0);
  shortest_.assign(column_slots, 0.0);
  row_of_column_.assign(column_slots, 0);
  previous_column_.assign(column_slots, 0);
  visited_.assign(column_slots, 0);
  for (int row = 1; row <= rows; ++row) augment(costs, transposed, max_cost, row, columns);

  column_of_row_.assign(static_cast<std::size_t>(costs.rows()), kUnassigned);
  for (int j = 1; j <= columns; ++j) {
    const int i = row_of_column_[static_cast<std::size_t>(j)];
    if (i == 0) continue;
    const int row = transposed ? j - 1 : i - 1;
    const int column = transposed ? i - 1 : j - 1;
    if (costs(row, column) < max_cost) column_of_row_[static_cast<std::size_t>(row)] = column;
  }
  return column_of_row_;
}

}  // namespace geoloc
