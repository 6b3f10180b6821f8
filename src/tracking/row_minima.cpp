// SPDX-License-Identifier: Apache-2.0
#include "tracking/row_minima.hpp"

#include "geometry/wide_registers.hpp"

namespace geoloc {
namespace {

inline void lower(Lanes& least, const Lanes& other) {
  least = other < least ? other : least;
}

inline double least_of(const Lanes& lanes) {
  const double first = lanes[0] < lanes[1] ? lanes[0] : lanes[1];
  const double second = lanes[2] < lanes[3] ? lanes[2] : lanes[3];
  return first < second ? first : second;
}

}  // namespace

GEOLOC_WIDE_REGISTERS
void lower_to_row(double* minimum, double* source, const double* row, double number, std::size_t blocks) {
  const Lanes numbers = Lanes{} + number;
  for (std::size_t j = 0; j < blocks * kMinimaBlock; j += kLanes) {
    const auto is_less = lanes(row + j) < lanes(minimum + j);
    lanes(minimum + j) = is_less ? lanes(row + j) : lanes(minimum + j);
    lanes(source + j) = is_less ? numbers : lanes(source + j);
  }
}

GEOLOC_WIDE_REGISTERS
void minima_of_reduced(const double* row, const double* price, double* block_minimum, std::size_t blocks) {
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t begin = b * kMinimaBlock;
    Lanes least = lanes(row + begin) - lanes(price + begin);
    for (std::size_t j = begin + kLanes; j < begin + kMinimaBlock; j += kLanes)
      lower(least, lanes(row + j) - lanes(price + j));
    block_minimum[b] = least_of(least);
  }
}

GEOLOC_WIDE_REGISTERS
void relax(const ColumnDistances& to, const double* row, const double* price, const double* taken,
           double offset, double number, std::size_t blocks) {
  const Lanes numbers = Lanes{} + number;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t begin = b * kMinimaBlock;
    Lanes least = lanes(to.distance + begin);
    Lanes least_free = least + lanes(taken + begin);
    for (std::size_t j = begin; j < begin + kMinimaBlock; j += kLanes) {
      const Lanes reached = lanes(row + j) - lanes(price + j) - offset;
      Lanes& distance = lanes(to.distance + j);
      Lanes& source = lanes(to.source + j);
      const auto is_nearer = reached < distance;
      distance = is_nearer ? reached : distance;
      source = is_nearer ? numbers : source;
      lower(least, distance);
      lower(least_free, distance + lanes(taken + j));
    }
    to.least_of_block[b] = least_of(least);
    to.least_free_block[b] = least_of(least_free);
  }
}

}  // namespace geoloc
