// SPDX-License-Identifier: Apache-2.0
#include "calibration/row_kernels.hpp"

#include "geometry/wide_registers.hpp"

namespace geoloc {
namespace {

inline double sum_of(const Lanes& lanes) {
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

}  // namespace

GEOLOC_WIDE_REGISTERS
double dot_of_rows(const double* x, const double* y, std::size_t size) {
  Lanes even = {}, odd = {};  // two sums that do not wait for each other
  std::size_t i = 0;
  for (; i + 2 * kLanes <= size; i += 2 * kLanes) {
    even += lanes(x + i).value * lanes(y + i).value;
    odd += lanes(x + i + kLanes).value * lanes(y + i + kLanes).value;
  }
  double rest = 0.0;
  for (; i < size; ++i) rest += x[i] * y[i];
  return sum_of(even + odd) + rest;
}

GEOLOC_WIDE_REGISTERS
std::array<double, 3> dots_of_rows(const double* x, const std::array<const double*, 3>& y, std::size_t size) {
  Lanes first = {}, second = {}, third = {};
  std::size_t i = 0;
  for (; i + kLanes <= size; i += kLanes) {
    first += lanes(x + i).value * lanes(y[0] + i).value;
    second += lanes(x + i).value * lanes(y[1] + i).value;
    third += lanes(x + i).value * lanes(y[2] + i).value;
  }
  const Lanes sums[] = {first, second, third};
  std::array<double, 3> dots;
  for (std::size_t k = 0; k < 3; ++k) {
    double rest = 0.0;
    for (std::size_t r = i; r < size; ++r) rest += x[r] * y[k][r];
    dots[k] = sum_of(sums[k]) + rest;
  }
  return dots;
}

GEOLOC_WIDE_REGISTERS
void subtract_rows(double* __restrict__ y, const std::array<double, 3>& a,
                   const std::array<const double*, 3>& x, std::size_t size) {
  const double a0 = a[0], a1 = a[1], a2 = a[2];
  const double* const __restrict__ x0 = x[0], * const __restrict__ x1 = x[1], * const __restrict__ x2 = x[2];
  for (std::size_t i = 0; i < size; ++i) y[i] -= a0 * x0[i] + a1 * x1[i] + a2 * x2[i];
}

}  // namespace geoloc
