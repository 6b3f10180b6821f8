// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace geoloc::testing {

/// Number of calls of operator new in this program so far. They are counted if support/allocation_counter.cpp
/// is linked.
std::size_t allocations();

}  // namespace geoloc::testing
