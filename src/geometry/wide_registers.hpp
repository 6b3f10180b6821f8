// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// A function marked so uses wider registers than the program is compiled for, where the processor has them.
/// Its results are the same to the last bit if what is added to what does not depend on their width: not FMA,
/// which rounds once where two roundings are due.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define GEOLOC_WIDE_REGISTERS __attribute__((target_clones("avx2", "default")))
#else
#define GEOLOC_WIDE_REGISTERS
#endif

namespace geoloc {

/// As many doubles side by side as the widest registers hold; the compiler splits them where they are
/// narrower.
inline constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

/// Lanes among other numbers, wherever they begin. (clang takes no notice of a lower alignment of Lanes
/// themselves, and reads them by instructions that fault.)
struct LanesInRow {
  Lanes value;
} __attribute__((packed, aligned(alignof(double)), may_alias));

inline const LanesInRow& lanes(const double* from) {
  return *reinterpret_cast<const LanesInRow*>(from);
}

inline LanesInRow& lanes(double* from) {
  return *reinterpret_cast<LanesInRow*>(from);
}

}  // namespace geoloc
