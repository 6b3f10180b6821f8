// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace geoloc {

/// So many pixels are computed at once, by the processor's vector instructions.
inline constexpr int kLanes = 8;
/// A number of each.
using Lanes = Eigen::Array<double, kLanes, 1>;

}  // namespace geoloc
