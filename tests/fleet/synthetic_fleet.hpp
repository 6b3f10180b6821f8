// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "geoloc/fleet/fusion.hpp"

/// Flights that are drawn from the very errors that their summaries state.
namespace geoloc::testing {

inline const Geodetic kFleetOrigin{-22.906, -43.133};

/// Errors of a flight, 1-sigma.
struct FlightErrors {
  double offset_m = 0.7;  ///< of the receiver, per axis
  double up_m = 0.5;
  double yaw_rad = 0.005;
  double own_m = 0.1;  ///< of each object by itself, per axis
  double own_up_m = 0.3;
};

/// In clusters of six, no two nearer than 1.2 m: east, north, up.
inline std::vector<Eigen::Vector3d> clustered_targets(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> field(-40.0, 40.0), around(-4.0, 4.0), height(0.0, 2.0);
  std::vector<Eigen::Vector3d> targets;
  Eigen::Vector2d centre(field(random), field(random));
  while (targets.size() < count) {
    const Eigen::Vector2d place = centre + Eigen::Vector2d(around(random), around(random));
    bool is_free = true;
    for (const Eigen::Vector3d& other : targets) is_free = is_free && (other.head<2>() - place).norm() >= 1.2;
    if (!is_free) continue;
    targets.emplace_back(place.x(), place.y(), height(random));
    if (targets.size() % 6 == 0) centre = {field(random), field(random)};
  }
  return targets;
}

inline void set_name(const std::string& name, FlightSummary& summary) {
  summary.identity = {name, "drone", 1};
}

/// Of all targets, or each with a probability; objects have their targets' numbers, from 1, as ids. The
/// errors' columns: east, north, up, yaw.
inline FlightSummary draw_flight(const std::string& name, const std::vector<Eigen::Vector3d>& targets,
                                 const FlightErrors& errors, std::mt19937& random, double share = 1.0) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const Eigen::Vector4d s(normal(random), normal(random), normal(random), normal(random));
  FlightSummary summary;
  set_name(name, summary);
  summary.origin = kFleetOrigin;
  summary.home_height_msl_m = 12.0;
  std::vector<Eigen::Matrix<double, 3, 4>> rows;
  for (std::size_t number = 0; number < targets.size(); ++number) {
    const Eigen::Vector3d& target = targets[number];
    if (uniform(random) >= share) continue;
    Eigen::Matrix<double, 3, 4> shared = Eigen::Matrix<double, 3, 4>::Zero();
    shared.leftCols<3>().diagonal() << errors.offset_m, errors.offset_m, errors.up_m;
    shared.col(3) << errors.yaw_rad * target.y(), -errors.yaw_rad * target.x(), 0.0;
    const Eigen::Vector3d own(errors.own_m * normal(random), errors.own_m * normal(random),
                              errors.own_up_m * normal(random));
    FlightSummary::Object object;
    object.id = number + 1;
    object.position_in_enu = target - shared * s - own;
    object.own_covariance.setZero();
    object.own_covariance.diagonal() << errors.own_m * errors.own_m, errors.own_m * errors.own_m,
        errors.own_up_m * errors.own_up_m;
    object.hits = 10;
    object.existence = 0.99;
    object.class_votes.add(0, 5.0);
    object.first_seen = HostTime{from_seconds(1e9)};
    object.last_seen = HostTime{from_seconds(1e9 + 60.0)};
    summary.objects.push_back(object);
    rows.push_back(shared);
  }
  summary.shared_error.resize(3 * static_cast<Eigen::Index>(rows.size()), 4);
  for (std::size_t i = 0; i < rows.size(); ++i)
    summary.shared_error.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = rows[i];
  return summary;
}

inline void move_east(double by_m, FlightSummary& summary) {
  for (FlightSummary::Object& object : summary.objects) object.position_in_enu.x() += by_m;
}

/// "flight-00" and so on.
inline std::string flight_name(std::size_t number) {
  return "flight-" + std::string(number < 10 ? "0" : "") + std::to_string(number);
}

inline Fleet draw_fleet(std::size_t flights, const std::vector<Eigen::Vector3d>& targets,
                        const FlightErrors& errors, std::mt19937& random, double share = 1.0) {
  Fleet fleet;
  for (std::size_t i = 0; i < flights; ++i)
    take(draw_flight(flight_name(i), targets, errors, random, share), fleet);
  return fleet;
}

/// The map against the truth. Objects of the drawn flights are called by the number of their target, so that
/// nothing has to be guessed by distance.
struct MapScore {
  std::size_t found = 0;   ///< targets that one object of the map is made of, and nothing else
  std::size_t extra = 0;   ///< objects beyond the first of a target
  std::size_t merged = 0;  ///< objects that are made of several targets
  double rmse_m = 0.0;
  double nees = 0.0;  ///< horizontal, per object: 2 is right
  Eigen::Vector2d mean_error_m = Eigen::Vector2d::Zero();
};

inline std::uint64_t target_of(const Contribution& contribution, const FusedMap& map, const Fleet& fleet) {
  return fleet.at(map.flights[contribution.flight].identity.flight).objects[contribution.object].id;
}

inline MapScore score_map(const FusedMap& map, const Fleet& fleet,
                          const std::vector<Eigen::Vector3d>& targets) {
  MapScore score;
  std::vector<bool> is_found(targets.size(), false);
  for (const FusedObject& object : map.objects) {
    const std::uint64_t target = target_of(object.contributions.front(), map, fleet);
    const bool is_pure = std::all_of(
        object.contributions.begin(), object.contributions.end(),
        [&](const Contribution& contribution) { return target_of(contribution, map, fleet) == target; });
    if (!is_pure) {
      ++score.merged;
    } else if (is_found[target - 1]) {
      ++score.extra;
    } else {
      is_found[target - 1] = true;
      ++score.found;
    }
    const Eigen::Vector2d error = (object.position_in_enu - targets[target - 1]).head<2>();
    score.rmse_m += error.squaredNorm();
    score.nees += error.dot(Eigen::Matrix2d(object.covariance.topLeftCorner<2, 2>()).inverse() * error);
    score.mean_error_m += error;
  }
  const auto objects = static_cast<double>(std::max<std::size_t>(map.objects.size(), 1));
  score.rmse_m = std::sqrt(score.rmse_m / objects);
  score.nees /= objects;
  score.mean_error_m /= objects;
  return score;
}

}  // namespace geoloc::testing
