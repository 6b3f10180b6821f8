// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace geoloc::testing {

/// What is asked of the heap while it exists, to the byte, by whatever way: it stands in front of the C
/// library's malloc(). One at a time, and only where support/heap_ledger.cpp is linked.
class HeapLedger {
 public:
  HeapLedger();
  ~HeapLedger();
  HeapLedger(const HeapLedger&) = delete;
  HeapLedger& operator=(const HeapLedger&) = delete;

  /// Asked for since the ledger exists, and not given back.
  std::size_t held_bytes() const;
  /// The most that was held at a time.
  std::size_t most_bytes() const;
};

}  // namespace geoloc::testing
