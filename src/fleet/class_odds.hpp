// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace geoloc {

/// Logarithm of how much less likely two objects are one where their classes differ: of many looks the
/// majority is seldom wrong.
inline double class_penalty(int class_id, int other) {
  constexpr double kDiffer = 3.0;  // one in twenty
  return class_id == other ? 0.0 : kDiffer;
}

}  // namespace geoloc
