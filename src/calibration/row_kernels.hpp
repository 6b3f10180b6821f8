// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace geoloc {

/// The inner loops of the head's solution, on rows as they lie in memory. Where the processor has wider
/// registers than the program is compiled for they are used; the results are the same to the last bit, since
/// what is added to what does not depend on their width.

/// x . y.
double dot_of_rows(const double* x, const double* y, std::size_t size);

/// x . y of three rows y.
std::array<double, 3> dots_of_rows(const double* x, const std::array<const double*, 3>& y, std::size_t size);

/// y -= a[0] x[0] + a[1] x[1] + a[2] x[2].
void subtract_rows(double* y, const std::array<double, 3>& a, const std::array<const double*, 3>& x,
                   std::size_t size);

}  // namespace geoloc
