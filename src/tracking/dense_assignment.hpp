// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace geoloc {

/// The assignment of every row to a column of its own at the least sum of costs: R. Jonker and A. Volgenant,
/// "A shortest augmenting path algorithm for dense and sparse linear assignment problems", Computing 38
/// (1987). Keeps its storage between problems.
class DenseAssignment {
 public:
  /// geometry/room.hpp
  static std::size_t take_room(DenseAssignment* self, std::size_t rows, std::size_t columns);

  /// The next problem; rows <= columns. Its costs, all finite, are to be written row by row.
  void begin(std::size_t rows, std::size_t columns);
  double* row(std::size_t i) { return costs_.data() + i * stride_; }

  /// The column of each row. Holds until the next begin().
  const std::vector<int>& solve();

 private:
  static constexpr int kFree = -1;

  struct TwoLeast;

  void reduce_columns();
  void reduce_rows();
  TwoLeast two_least(std::size_t row);
  std::optional<int> free_column_at(std::size_t row, double least);
  void augment(int free_row);
  int column_at(double distance, bool must_be_free) const;
  void give(int column, int row);

  std::size_t rows_ = 0, columns_ = 0, blocks_ = 0, stride_ = 0;
  std::vector<double> costs_;  // row by row; rows are filled up with infinite costs to whole blocks
  std::vector<double> price_;  // of each column: no row has a column that is cheaper after prices
  std::vector<double> taken_;  // infinite for a column that has a row, else 0
  std::vector<int> row_of_column_, column_of_row_;
  std::vector<int> free_rows_;
  // Scratch.
  std::vector<double> block_minimum_, free_block_minimum_;
  std::vector<double> source_;      // the row that a column's price or distance comes from
  std::vector<double> distance_;    // to the columns that are not reached for good
  std::vector<double> open_price_;  // minus infinity where reached for good
  std::vector<int> reached_;        // for good, in their order
  std::vector<double> reached_at_;  // their distances
};

}  // namespace geoloc
