// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace geoloc {

/// Rows and columns of a cost matrix that concern each other: connected by costs below the limit, over any
/// number of others. What connects to nothing is in none. Keeps its storage between matrices.
class GatedComponents {
 public:
  struct Span {
    const int* begin_;
    const int* end_;
    const int* begin() const { return begin_; }
    const int* end() const { return end_; }
    std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
    int operator[](std::size_t i) const { return begin_[i]; }
  };

  /// geometry/room.hpp
  static std::size_t take_room(GatedComponents* self, std::size_t rows, std::size_t columns);

  void find(const Eigen::Ref<const Eigen::MatrixXd>& costs, double limit);

  std::size_t size() const { return size_; }
  /// In ascending order.
  Span rows(std::size_t component) const { return span(rows_, rows_begin_, component); }
  Span columns(std::size_t component) const { return span(columns_, columns_begin_, component); }

 private:
  static Span span(const std::vector<int>& of, const std::vector<int>& begin, std::size_t component) {
    return {of.data() + begin[component], of.data() + begin[component + 1]};
  }
  int root(int row);
  int connect(const double* column, int rows, double limit);

  std::vector<int> parent_;  // of each row: a forest, whose roots stand for components
  std::size_t separate_rows_ = 0;
  std::size_t size_ = 0;
  std::vector<int> component_of_row_, component_of_column_;
  std::vector<int> rows_, rows_begin_, columns_, columns_begin_;
};

}  // namespace geoloc
