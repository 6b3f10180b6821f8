// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

namespace geoloc {

/// Optimal assignment of rows to columns (Hungarian method in the shortest-augmenting-path form of Jonker and
/// Volgenant). Rectangular; O(rows^2 * columns) for rows <= columns, and the same with the roles exchanged.
///
/// Costs at or above `max_cost` (or NaN) mean "rather leave both alone": the result minimises the sum of the
/// pairs' costs where every row left alone counts max_cost. Keeps its storage between calls.
class AssignmentSolver {
 public:
  static constexpr std::size_t kUnassigned = std::numeric_limits<std::size_t>::max();

  /// Room for problems of this size without further allocation.
  void reserve(int rows, int columns);

  /// costs(row, column); max_cost finite. Returns the column of each row, or kUnassigned. The reference holds
  /// until the next call.
  const std::vector<std::size_t>& solve(const Eigen::Ref<const Eigen::MatrixXd>& costs, double max_cost);

 private:
  void augment(const Eigen::Ref<const Eigen::MatrixXd>& costs, bool transposed, double max_cost, int row,
               int columns);

  // 1-based in the columns: column 0 stands for the row being placed.
  std::vector<double> row_potential_, column_potential_, shortest_;
  std::vector<int> row_of_column_, previous_column_;
  std::vector<std::size_t> column_of_row_;
  std::vector<char> visited_;
};

}  // namespace geoloc
