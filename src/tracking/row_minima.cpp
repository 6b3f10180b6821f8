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
    const auto is_less = lanes(row + j).value < lanes(minimum + j).value;
    lanes(minimum + j).value = is_less ? lanes(row + j).value : lanes(minimum + j).value;
    lanes(source + j).value = is_less ? numbers : lanes(source + j).value;
  }
}

GEOLOC_WIDE_REGISTERS
void minima_of_reduced(const double* row, const double* price, double* block_minimum, std::size_t blocks) {
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t begin = b * kMinimaBlock;
    Lanes least = lanes(row + begin).value - lanes(price + begin).value;
    for (std::size_t j = begin + kLanes; j < begin + kMinimaBlock; j += kLanes)
      lower(least, lanes(row + j).value - lanes(price + j).value);
    block_minimum[b] = least_of(least);
  }
}

GEOLOC_WIDE_REGISTERS
void relax(const ColumnDistances& to, const double* row, const double* price, const double* taken,
           double offset, double number, std::size_t blocks) {
  const Lanes numbers = Lanes{} + number;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t begin = b * kMinimaBlock;
    Lanes least = lanes(to.distance + begin).value;
    Lanes least_free = least + lanes(taken + begin).value;
    for (std::size_t j = begin; j < begin + kMinimaBlock; j += kLanes) {
      const Lanes reached = lanes(row + j).value - lanes(price + j).value - offset;
      const Lanes before = lanes(to.distance + j).value;
      const auto is_nearer = reached < before;
      const Lanes distance = is_nearer ? reached : before;
      lanes(to.distance + j).value = distance;
      lanes(to.source + j).value = is_nearer ? numbers : lanes(to.source + j).value;
      lower(least, distance);
      lower(least_free, distance + lanes(taken + j).value);
    }
    to.least_of_block[b] = least_of(least);
    to.least_free_block[b] = least_of(least_free);
  }
}

}  // namespace geoloc
