// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace geoloc {

/// Optimal assignment of rows to columns (the Hungarian method in the form of Jonker and Volgenant, 1987), of
/// rectangular matrices, too; what does not concern each other is solved apart. O(rows^2 * columns) at worst
/// for rows <= columns, and the same with the roles exchanged.
///
/// Costs at or above `max_cost` (or NaN) mean "rather leave both alone": the result minimises the sum of the
/// pairs' costs where every row left alone counts max_cost. Keeps its storage between calls.
class AssignmentSolver {
 public:
  static constexpr std::size_t kUnassigned = std::numeric_limits<std::size_t>::max();

  AssignmentSolver();
  ~AssignmentSolver();
  AssignmentSolver(AssignmentSolver&&) noexcept;
  AssignmentSolver& operator=(AssignmentSolver&&) noexcept;

  /// Room for problems of this size without further allocation.
  void reserve(int rows, int columns);

  /// What a solver with that room asks of the heap.
  static std::size_t bytes(int rows, int columns);

  /// costs(row, column), above minus infinity; max_cost finite. Returns the column of each row, or
  /// kUnassigned. The reference holds until the next call.
  const std::vector<std::size_t>& solve(const Eigen::Ref<const Eigen::MatrixXd>& costs, double max_cost);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace geoloc
