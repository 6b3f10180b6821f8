// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

namespace geoloc::io::hostile {

/// What a reader accepts must be usable: ends the program where it is not, which fuzzers and tests notice.
inline void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace geoloc::io::hostile
