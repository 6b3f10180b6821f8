// SPDX-License-Identifier: Apache-2.0
#include "geoloc/evaluation/score.hpp"

#include <algorithm>
#include <cmath>

#include "geoloc/tracking/assignment.hpp"
#include "tracking/gaussian.hpp"

namespace geoloc {
namespace {

double root_mean_square(const std::vector<Eigen::Vector2d>& errors, const Eigen::Vector2d& offset) {
  double sum = 0.0;
  for (const Eigen::Vector2d& error : errors) sum += (error - offset).squaredNorm();
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

/// Counts targets that were not found although a neighbour within reach was: the neighbour's object took the
/// detections of both.
int count_merged_pairs(const std::vector<Eigen::Vector2d>& targets, const std::vector<char>& is_found) {
  int pairs = 0;
  for (std::size_t lost = 0; lost < targets.size(); ++lost) {
    if (is_found[lost] != 0) continue;
    for (std::size_t other = 0; other < targets.size(); ++other) {
      if (is_found[other] != 0 && (targets[lost] - targets[other]).norm() <= kFarthestMatch_m) {
        ++pairs;
        break;
      }
    }
  }
  return pairs;
}

}  // namespace

Score score_objects(const std::vector<Eigen::Vector2d>& objects,
                    const std::vector<Eigen::Vector2d>& targets) {
  Eigen::MatrixXd distances(static_cast<Eigen::Index>(objects.size()),
                            static_cast<Eigen::Index>(targets.size()));
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t j = 0; j < targets.size(); ++j) {
      distances(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          (objects[i] - targets[j]).norm();
    }
  }
  AssignmentSolver solver;
  Score score;
  for (const std::size_t target : solver.solve(distances, kFarthestMatch_m)) {
    const bool is_matched = target != AssignmentSolver::kUnassigned;
    score.target_of_object.push_back(is_matched ? std::optional(target) : std::nullopt);
  }
  score.targets = static_cast<int>(targets.size());
  score.objects = static_cast<int>(objects.size());

  std::vector<Eigen::Vector2d> errors;
  std::vector<char> is_found(targets.size(), 0);
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto target = score.target_of_object[i];
    if (!target) continue;
    is_found[*target] = 1;
    errors.push_back(objects[i] - targets[*target]);
    offset += errors.back();
  }
  score.found = static_cast<int>(errors.size());
  score.extra = score.objects - score.found;
  score.merged_pairs = count_merged_pairs(targets, is_found);
  if (distances.size() > 0) score.nearest_m = distances.minCoeff();
  if (errors.empty()) return score;
  score.rmse_m = root_mean_square(errors, Eigen::Vector2d::Zero());
  score.relative_rmse_m = root_mean_square(errors, offset / static_cast<double>(errors.size()));
  return score;
}

HeightScore score_heights(const std::vector<double>& errors_m) {
  if (errors_m.empty()) return {};
  const Eigen::Map<const Eigen::ArrayXd> errors(errors_m.data(), static_cast<Eigen::Index>(errors_m.size()));
  return {std::sqrt(errors.square().mean()), std::sqrt((errors - errors.mean()).square().mean())};
}

double mean_nees(const std::vector<Gaussian2>& objects, const std::vector<Eigen::Vector2d>& targets,
                 const std::vector<std::optional<std::size_t>>& target_of_object) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!target_of_object[i]) continue;
    const Eigen::Vector2d error = objects[i].mean - targets[*target_of_object[i]];
    sum += mahalanobis_squared(error, objects[i].covariance);
    ++count;
  }
  return count == 0 ? 0.0 : sum / count;
}

}  // namespace geoloc
