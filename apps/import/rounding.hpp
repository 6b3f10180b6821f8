// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace geoloc::apps {

/// One, or the tenth, hundredth, … of one that all values are multiples of, `finest` at least; 0: there is
/// none.
double rounding_step(const std::vector<double>& values, double finest);

/// What a quantity that changes smoothly was at times that increase, where `rounded` tells it to multiples of
/// `step`: its mean, given that each lies within half a step of what is told, and that its rate changes by
/// white noise, mostly of 0.3 a second in a second, and now and then of far more (a vehicle that turns) [s].
/// No value is farther than half a step from what is told.
std::vector<double> unrounded(const std::vector<double>& time_s, const std::vector<double>& rounded,
                              double step);

}  // namespace geoloc::apps
