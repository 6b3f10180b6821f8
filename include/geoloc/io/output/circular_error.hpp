// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace geoloc::io {

/// Radius of the circle around the mean that contains the given share of a two-dimensional Gaussian with
/// these 1-sigma semi-axes, in their unit. With a minor axis of 0 it is the interval in one dimension.
/// Accurate to 1e-3 of the radius; NaN if an axis is negative or not finite, or the probability not within
/// (0, 1).
double circular_error(double sigma_major, double sigma_minor, double probability);

}  // namespace geoloc::io
