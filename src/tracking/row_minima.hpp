// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace geoloc {

/// The inner loops of the assignment, over rows of costs in blocks of so many; the least values of the blocks
/// tell where to look for the least of all.
inline constexpr std::size_t kMinimaBlock = 16;

constexpr std::size_t blocks_for(std::size_t columns) {
  return (columns + kMinimaBlock - 1) / kMinimaBlock;
}

/// Where row[j] is less than minimum[j], it takes its place, and `number` that of source[j].
void lower_to_row(double* minimum, double* source, const double* row, double number, std::size_t blocks);

/// block_minimum[b] = the least of row - price in block b.
void minima_of_reduced(const double* row, const double* price, double* block_minimum, std::size_t blocks);

/// The shortest distances to the columns, as far as they are known.
struct ColumnDistances {
  double* distance;
  double* source;            ///< which row they come from
  double* least_of_block;    ///< the least in each block,
  double* least_free_block;  ///< and the least to columns that have no row
};

/// Where row[j] - price[j] - offset is less than distance[j], it takes its place, and `number` that of
/// source[j]. taken[j]: infinite where a column has a row, else 0.
void relax(const ColumnDistances& to, const double* row, const double* price, const double* taken,
           double offset, double number, std::size_t blocks);

}  // namespace geoloc
