// SPDX-License-Identifier: Apache-2.0
#include "tracking/gated_components.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/room.hpp"

namespace geoloc {
namespace {

constexpr int kNone = -1;

/// The items of each component in ascending order, one component after the other; begin[c] is where those of
/// c begin. Counts are kept two places further on, where filling turns them into beginnings.
void group(const std::vector<int>& component_of_item, std::size_t components, std::vector<int>& items,
           std::vector<int>& begin) {
  begin.assign(components + 2, 0);
  for (const int component : component_of_item)
    if (component != kNone) ++begin[component + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  items.resize(begin.back());
  for (std::size_t i = 0; i < component_of_item.size(); ++i)
    if (component_of_item[i] != kNone) items[begin[component_of_item[i] + 1]++] = static_cast<int>(i);
  begin.pop_back();
}

}  // namespace

std::size_t GatedComponents::take_room(GatedComponents* self, std::size_t rows, std::size_t columns) {
  using Self = GatedComponents;
  std::size_t bytes = 0;
  for (auto numbers : {&Self::parent_, &Self::component_of_row_, &Self::rows_})
    bytes += room::reserve(self, numbers, rows);
  for (auto numbers : {&Self::component_of_column_, &Self::columns_})
    bytes += room::reserve(self, numbers, columns);
  for (auto numbers : {&Self::rows_begin_, &Self::columns_begin_})
    bytes += room::reserve(self, numbers, rows + 2);
  return bytes;
}

int GatedComponents::root(int row) {
  while (parent_[row] != row) {
    parent_[row] = parent_[parent_[row]];
    row = parent_[row];
  }
  return row;
}

/// Joins the rows that a column connects, and returns the first of them. Where all rows are one component
/// already, that tells all.
int GatedComponents::connect(const double* column, int rows, double limit) {
  int first = kNone;
  for (int i = 0; i < rows; ++i) {
    if (!(column[i] < limit)) continue;
    if (first == kNone) {
      first = i;
    } else if (const int here = root(i), there = root(first); here != there) {
      parent_[std::max(here, there)] = std::min(here, there);
      --separate_rows_;
    }
    if (separate_rows_ == 1) break;
  }
  return first;
}

void GatedComponents::find(const Eigen::Ref<const Eigen::MatrixXd>& costs, double limit) {
  const int rows = static_cast<int>(costs.rows());
  parent_.resize(rows);
  std::iota(parent_.begin(), parent_.end(), 0);
  separate_rows_ = rows;
  component_of_column_.clear();
  for (Eigen::Index j = 0; j < costs.cols(); ++j)
    component_of_column_.push_back(connect(costs.col(j).data(), rows, limit));

  size_ = 0;
  component_of_row_.assign(rows, kNone);
  for (int& row_or_component : component_of_column_) {
    if (row_or_component == kNone) continue;
    int& component = component_of_row_[root(row_or_component)];
    if (component == kNone) component = static_cast<int>(size_++);
    row_or_component = component;
  }
  for (int i = 0; i < rows; ++i) component_of_row_[i] = component_of_row_[root(i)];
  group(component_of_row_, size_, rows_, rows_begin_);
  group(component_of_column_, size_, columns_, columns_begin_);
}

}  // namespace geoloc
