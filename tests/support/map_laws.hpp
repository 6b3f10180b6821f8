// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "geoloc/tracking/track.hpp"

namespace geoloc::testing {

/// The only confirmed object so near to the place; nullptr where there is none, or where there are several.
inline const Track* object_at(const Eigen::Vector2d& place, const std::vector<Track>& tracks,
                              double within_m) {
  const Track* found = nullptr;
  for (const Track& track : tracks) {
    if (track.status != TrackStatus::kConfirmed) continue;
    if ((track.position_in_enu.mean - place).norm() > within_m) continue;
    if (found != nullptr) return nullptr;
    found = &track;
  }
  return found;
}

/// Every place has one confirmed object within its sigmas, and there is no other.
inline void expect_each_place_once(const std::vector<Eigen::Vector2d>& places,
                                   const std::vector<Track>& tracks) {
  std::vector<int> objects(places.size(), 0);
  for (const Track& track : tracks) {
    if (track.status != TrackStatus::kConfirmed) continue;
    const auto nearest = std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
      return (a - track.position_in_enu.mean).norm() < (b - track.position_in_enu.mean).norm();
    });
    ++objects[static_cast<std::size_t>(nearest - places.begin())];
    const double sigma_m = std::sqrt(track.position_in_enu.covariance.trace());
    EXPECT_LT((*nearest - track.position_in_enu.mean).norm(), std::min(4.0 * sigma_m, 0.3));
  }
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(objects[i], 1) << places[i].transpose();
}

}  // namespace geoloc::testing
