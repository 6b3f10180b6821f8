// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "geoloc/tracking/track.hpp"

namespace geoloc {

/// An object farther from a target is not its.
inline constexpr double kFarthestMatch_m = 3.0;

/// How well a run found the targets (docs/formats.md, scoring).
struct Score {
  int targets = 0;
  int objects = 0;
  int found = 0;                 ///< targets with an object of their own within 3 m
  int extra = 0;                 ///< objects without a target
  int merged_pairs = 0;          ///< a target without an object beside one whose object stands for both
  std::optional<double> rmse_m;  ///< over the targets found; nullopt where there is none
  std::optional<double> relative_rmse_m;  ///< the same with the run's mean offset removed
  std::optional<double> nearest_m;        ///< least distance of an object to a target, matched or not
  std::vector<std::optional<std::size_t>> target_of_object;  ///< nullopt: none
};

/// Objects are matched one-to-one to targets at minimum total distance; pairs over 3 m do not count. East,
/// north [m].
Score score_objects(const std::vector<Eigen::Vector2d>& objects, const std::vector<Eigen::Vector2d>& targets);

/// How far off the heights of the matched objects are.
struct HeightScore {
  double rmse_m = 0.0;
  double relative_rmse_m = 0.0;  ///< with the run's mean error removed
};

/// `errors_m`: estimated minus true.
HeightScore score_heights(const std::vector<double>& errors_m);

/// Mean over the matched objects of the squared error in units of the stated covariance (NEES); 2 where the
/// covariance is right, 0 where nothing was matched.
double mean_nees(const std::vector<Gaussian2>& objects, const std::vector<Eigen::Vector2d>& targets,
                 const std::vector<std::optional<std::size_t>>& target_of_object);

}  // namespace geoloc
