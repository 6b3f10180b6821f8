// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace geoloc::testing {

/// Calls of operator new in this program so far. Linking support/allocation_counter.cpp makes them counted.
std::size_t allocations();

}  // namespace geoloc::testing
