// SPDX-License-Identifier: Apache-2.0
// AssignmentSolver for Python's ctypes, timed where it runs: a call from Python costs more than a small
// problem.
#include <chrono>

#include "geoloc/tracking/assignment.hpp"

extern "C" {

void* assignment_solver() {
  return new geoloc::AssignmentSolver();
}

/// Solves the problem of column-major costs so many times; returns the time of one [ns]. column_of_row: -1
/// where a row is left alone.
double assignment_time_ns(void* solver, const double* costs, long rows, long columns, double max_cost,
                          long times, long* column_of_row) {
  auto& assignment = *static_cast<geoloc::AssignmentSolver*>(solver);
  const Eigen::Map<const Eigen::MatrixXd> matrix(costs, rows, columns);
  const auto begin = std::chrono::steady_clock::now();
  for (long i = 0; i < times; ++i) assignment.solve(matrix, max_cost);
  const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
  const auto& result = assignment.solve(matrix, max_cost);
  for (std::size_t row = 0; row < result.size(); ++row)
    column_of_row[row] =
        result[row] == geoloc::AssignmentSolver::kUnassigned ? -1 : static_cast<long>(result[row]);
  return took.count() / static_cast<double>(times);
}

}  // extern "C"
