// SPDX-License-Identifier: Apache-2.0
#include "tracking/dense_assignment.hpp"

#include <algorithm>
#include <limits>

#include "geometry/room.hpp"
#include "tracking/row_minima.hpp"

namespace geoloc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kPasses = 2;  // of the row reduction, as in the paper
// How often rows take columns from each other. Where rows compete for few columns, as points in a plane do,
// more costs more than the shortest paths that it saves; and it would never end where costs differ by
// rounding errors.
constexpr std::size_t kMostExchangesPerRow = 1;

}  // namespace

/// The two least of some values, and where they are.
struct DenseAssignment::TwoLeast {
  double least = kInfinity, next = kInfinity;
  int place = 0, next_place = 0;

  void offer(double value, int where) {
    if (value < least) {
      next = least;
      next_place = place;
      least = value;
      place = where;
    } else if (value < next) {
      next = value;
      next_place = where;
    }
  }
};

std::size_t DenseAssignment::take_room(DenseAssignment* self, std::size_t rows, std::size_t columns) {
  using Self = DenseAssignment;
  const std::size_t blocks = blocks_for(columns), stride = blocks * kMinimaBlock;
  std::size_t bytes = room::reserve(self, &Self::costs_, rows * stride) +
                      room::reserve(self, &Self::reached_at_, columns) +
                      room::reserve(self, &Self::block_minimum_, blocks) +
                      room::reserve(self, &Self::free_block_minimum_, blocks);
  for (auto values : {&Self::price_, &Self::taken_, &Self::distance_, &Self::source_, &Self::open_price_})
    bytes += room::reserve(self, values, stride);
  for (auto values : {&Self::row_of_column_, &Self::reached_}) bytes += room::reserve(self, values, columns);
  for (auto values : {&Self::column_of_row_, &Self::free_rows_}) bytes += room::reserve(self, values, rows);
  return bytes;
}

void DenseAssignment::begin(std::size_t rows, std::size_t columns) {
  rows_ = rows;
  columns_ = columns;
  blocks_ = blocks_for(columns);
  stride_ = blocks_ * kMinimaBlock;
  costs_.resize(rows * stride_);
  for (std::size_t i = 0; i < rows; ++i) std::fill(row(i) + columns, row(i) + stride_, kInfinity);
  price_.assign(stride_, 0.0);
  taken_.assign(stride_, 0.0);
  row_of_column_.assign(columns, kFree);
  column_of_row_.assign(rows, kFree);
  block_minimum_.resize(blocks_);
  free_block_minimum_.resize(blocks_);
}

const std::vector<int>& DenseAssignment::solve() {
  if (rows_ == columns_) reduce_columns();
  free_rows_.clear();
  for (std::size_t i = 0; i < rows_; ++i)
    if (column_of_row_[i] == kFree) free_rows_.push_back(static_cast<int>(i));
  for (int pass = 0; pass < kPasses && !free_rows_.empty(); ++pass) reduce_rows();
  for (const int free_row : free_rows_) augment(free_row);
  return column_of_row_;
}

void DenseAssignment::give(int column, int row) {
  taken_[column] = kInfinity;
  row_of_column_[column] = row;
  column_of_row_[row] = column;
}

/// Every column costs nothing to its cheapest row. Only where all columns are needed: the price of one that
/// stays free must be that of all free ones.
void DenseAssignment::reduce_columns() {
  std::fill(price_.begin(), price_.end(), kInfinity);
  source_.assign(stride_, 0.0);
  for (std::size_t i = 0; i < rows_; ++i)
    lower_to_row(price_.data(), source_.data(), row(i), static_cast<double>(i), blocks_);
  std::fill(price_.begin() + columns_, price_.end(), 0.0);
  for (std::size_t j = 0; j < columns_; ++j) {
    const int cheapest = static_cast<int>(source_[j]);
    if (column_of_row_[cheapest] == kFree) give(static_cast<int>(j), cheapest);
  }
}

/// The least cost of a row after prices, and the least in another column.
DenseAssignment::TwoLeast DenseAssignment::two_least(std::size_t i) {
  minima_of_reduced(row(i), price_.data(), block_minimum_.data(), blocks_);
  TwoLeast of_blocks, of_columns;
  for (std::size_t b = 0; b < blocks_; ++b) of_blocks.offer(block_minimum_[b], static_cast<int>(b));
  const auto look_into = [&](int block) {
    const int begin = block * static_cast<int>(kMinimaBlock);
    const int end = std::min(begin + static_cast<int>(kMinimaBlock), static_cast<int>(columns_));
    for (int j = begin; j < end; ++j) of_columns.offer(row(i)[j] - price_[j], j);
  };
  look_into(of_blocks.place);
  if (of_blocks.next < of_columns.next) look_into(of_blocks.next_place);
  return of_columns;
}

/// A free column that costs the row so much after prices, if there is one. The row is the one that
/// two_least() saw last.
std::optional<int> DenseAssignment::free_column_at(std::size_t i, double least) {
  for (std::size_t b = 0; b < blocks_; ++b) {
    if (block_minimum_[b] != least) continue;
    for (std::size_t j = b * kMinimaBlock; j < std::min((b + 1) * kMinimaBlock, columns_); ++j)
      if (row_of_column_[j] == kFree && row(i)[j] - price_[j] == least) return static_cast<int>(j);
  }
  return std::nullopt;
}

/// A free row takes its cheapest column, whose price falls until its second cheapest costs as much; a row
/// that had the column before looks for another one at once, if that can cost it less than before.
void DenseAssignment::reduce_rows() {
  std::size_t exchanges = kMostExchangesPerRow * rows_, kept = 0;
  for (std::size_t k = 0; k < free_rows_.size();) {
    const int row = free_rows_[k++];
    const TwoLeast two = two_least(row);
    const bool is_strict = two.least < two.next;
    int column = two.place;
    if (is_strict) {
      if (two.next < kInfinity) price_[column] -= two.next - two.least;
    } else if (row_of_column_[column] != kFree) {
      column = free_column_at(row, two.least).value_or(two.next_place);
    }
    const int before = row_of_column_[column];
    give(column, row);
    if (before == kFree) continue;
    column_of_row_[before] = kFree;
    if (is_strict && exchanges > 0) {
      --exchanges;
      free_rows_[--k] = before;
    } else {
      free_rows_[kept++] = before;
    }
  }
  free_rows_.resize(kept);
}

/// A column, or a free one, of that distance, which is the least of its block.
int DenseAssignment::column_at(double distance, bool must_be_free) const {
  const std::vector<double>& least_of_block = must_be_free ? free_block_minimum_ : block_minimum_;
  const auto block = std::find(least_of_block.begin(), least_of_block.end(), distance);
  std::size_t j = kMinimaBlock * static_cast<std::size_t>(block - least_of_block.begin());
  while (distance_[j] != distance || (must_be_free && taken_[j] > 0.0)) ++j;
  return static_cast<int>(j);
}

/// Dijkstra's shortest path from the free row to a free column, over costs after prices.
void DenseAssignment::augment(int free_row) {
  distance_.assign(stride_, kInfinity);
  source_.assign(stride_, 0.0);
  open_price_ = price_;
  reached_.clear();
  reached_at_.clear();

  int from = free_row, nearest = kFree;
  double offset = 0.0, distance = 0.0;
  while (true) {
    relax({distance_.data(), source_.data(), block_minimum_.data(), free_block_minimum_.data()}, row(from),
          open_price_.data(), taken_.data(), offset, from, blocks_);
    distance = *std::min_element(block_minimum_.begin(), block_minimum_.end());
    if (*std::min_element(free_block_minimum_.begin(), free_block_minimum_.end()) <= distance) {
      nearest = column_at(distance, true);
      break;
    }
    nearest = column_at(distance, false);
    reached_.push_back(nearest);
    reached_at_.push_back(distance);
    distance_[nearest] = kInfinity;
    open_price_[nearest] = -kInfinity;
    from = row_of_column_[nearest];
    offset = row(from)[nearest] - price_[nearest] - distance;
  }
  for (std::size_t k = 0; k < reached_.size(); ++k) price_[reached_[k]] += reached_at_[k] - distance;

  for (int column = nearest; column != kFree;) {  // turn the path round
    const int row = static_cast<int>(source_[column]);
    const int before = column_of_row_[row];
    give(column, row);
    column = before;
  }
}

}  // namespace geoloc
