// SPDX-License-Identifier: Apache-2.0
#include "geoloc/tracking/assignment.hpp"

#include <algorithm>

#include "geometry/room.hpp"
#include "tracking/dense_assignment.hpp"
#include "tracking/gated_components.hpp"

namespace geoloc {
namespace {

using Costs = Eigen::Ref<const Eigen::MatrixXd>;
using Numbers = GatedComponents::Span;

/// A pair that is worse than leaving both alone costs exactly as much: it can be chosen only for nothing, and
/// is then dropped.
double capped(double cost, double max_cost) {
  return cost < max_cost ? cost : max_cost;  // NaN gives max_cost
}

/// Each column of the costs becomes a row: both lie in memory one number after the other.
void fill_transposed(DenseAssignment& problem, const Costs& costs, double max_cost, Numbers rows,
                     Numbers columns) {
  problem.begin(columns.size(), rows.size());
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const double* const from = costs.col(columns[j]).data();
    double* const to = problem.row(j);
    for (std::size_t i = 0; i < rows.size(); ++i) to[i] = capped(from[rows[i]], max_cost);
  }
}

void fill(DenseAssignment& problem, const Costs& costs, double max_cost, Numbers rows, Numbers columns) {
  problem.begin(rows.size(), columns.size());
  constexpr std::size_t kTogether = 8;  // columns, so that both matrices are walked in long stretches
  for (std::size_t first = 0; first < columns.size(); first += kTogether) {
    const std::size_t last = std::min(first + kTogether, columns.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = first; j < last; ++j)
        problem.row(i)[j] = capped(costs(rows[i], columns[j]), max_cost);
  }
}

}  // namespace

struct AssignmentSolver::Workspace {
  GatedComponents components;
  DenseAssignment problem;
  std::vector<std::size_t> column_of_row;

  static std::size_t take_room(Workspace* self, int rows, int columns);
  void solve(const Costs& costs, double max_cost, Numbers rows, Numbers columns);
  void pair(const Costs& costs, double max_cost, int row, int column);
};

AssignmentSolver::AssignmentSolver() : workspace_(std::make_unique<Workspace>()) {}
AssignmentSolver::~AssignmentSolver() = default;
AssignmentSolver::AssignmentSolver(AssignmentSolver&&) noexcept = default;
AssignmentSolver& AssignmentSolver::operator=(AssignmentSolver&&) noexcept = default;

void AssignmentSolver::reserve(int rows, int columns) {
  Workspace::take_room(workspace_.get(), rows, columns);
}

std::size_t AssignmentSolver::bytes(int rows, int columns) {
  return sizeof(Workspace) + Workspace::take_room(nullptr, rows, columns);
}

std::size_t AssignmentSolver::Workspace::take_room(Workspace* self, int rows, int columns) {
  return GatedComponents::take_room(room::part(self, &Workspace::components), rows, columns) +
         DenseAssignment::take_room(room::part(self, &Workspace::problem), std::min(rows, columns),
                                    std::max(rows, columns)) +
         room::reserve(self, &Workspace::column_of_row, rows);
}

const std::vector<std::size_t>& AssignmentSolver::solve(const Costs& costs, double max_cost) {
  GatedComponents& components = workspace_->components;
  components.find(costs, max_cost);
  workspace_->column_of_row.assign(costs.rows(), kUnassigned);
  for (std::size_t k = 0; k < components.size(); ++k)
    workspace_->solve(costs, max_cost, components.rows(k), components.columns(k));
  return workspace_->column_of_row;
}

void AssignmentSolver::Workspace::solve(const Costs& costs, double max_cost, Numbers rows, Numbers columns) {
  if (rows.size() == 1 && columns.size() == 1) return pair(costs, max_cost, rows[0], columns[0]);
  const bool is_transposed = columns.size() <= rows.size();
  (is_transposed ? fill_transposed : fill)(problem, costs, max_cost, rows, columns);
  const std::vector<int>& solution = problem.solve();
  for (std::size_t k = 0; k < solution.size(); ++k) {
    if (is_transposed) {
      pair(costs, max_cost, rows[solution[k]], columns[k]);
    } else {
      pair(costs, max_cost, rows[k], columns[solution[k]]);
    }
  }
}

void AssignmentSolver::Workspace::pair(const Costs& costs, double max_cost, int row, int column) {
  if (costs(row, column) < max_cost) column_of_row[row] = column;
}

}  // namespace geoloc
