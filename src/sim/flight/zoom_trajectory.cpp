// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/zoom_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace geoloc::sim {

ZoomTrajectory::ZoomTrajectory(std::vector<Sample> samples) : samples_(std::move(samples)) {
  const auto does_not_rise = [](const Sample& a, const Sample& b) { return a.first >= b.first; };
  const auto is_none = [](const Sample& sample) { return !(sample.second > 0.0); };
  if (samples_.size() < 2 || std::any_of(samples_.begin(), samples_.end(), is_none) ||
      std::adjacent_find(samples_.begin(), samples_.end(), does_not_rise) != samples_.end())
    throw std::invalid_argument("a zoom needs two samples at least, whose times rise, above 0");
}

double ZoomTrajectory::zoom(VehicleTime time) const {
  const auto is_later = [](VehicleTime t, const Sample& sample) { return t < sample.first; };
  const auto after = std::upper_bound(samples_.begin() + 1, samples_.end() - 1, time, is_later);
  const Sample &a = *(after - 1), &b = *after;
  const double fraction = std::clamp(seconds(time - a.first) / seconds(b.first - a.first), 0.0, 1.0);
  return a.second * std::pow(b.second / a.second, fraction);
}

}  // namespace geoloc::sim
