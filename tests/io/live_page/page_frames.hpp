// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geoloc/io/output/output_frame.hpp"

namespace geoloc::io::testing {

/// An object somewhere near the equator, distinct by its id.
ObjectReport page_object(std::uint64_t id);

/// The frame of that number of a run: a vehicle that flies east, a fix, and `objects` confirmed objects.
OutputFrame page_frame(int number, std::uint64_t objects);

}  // namespace geoloc::io::testing
