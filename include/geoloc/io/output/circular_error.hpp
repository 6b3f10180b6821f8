// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace geoloc::io {

/// Radius of the circle about the mean that holds the given share of a Gaussian in the plane with these
/// 1-sigma semi-axes, in their unit. With a minor axis of 0 it is the interval of one dimension. Good to
/// 1e-3 of the radius; NaN where an axis is not finite or negative, or the probability not within (0, 1).
double circular_error(double sigma_major, double sigma_minor, double probability);

}  // namespace geoloc::io
