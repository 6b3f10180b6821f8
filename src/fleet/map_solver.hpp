// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "fleet/flight_model.hpp"
#include "geoloc/fleet/fusion.hpp"

namespace geoloc {

/// Which objects of the flights are one, as the fleet's map has it. In order of the flights.
using Members = std::vector<Contribution>;

/// Takes out those that no flight has any more.
inline void drop_empty(std::vector<Members>& objects) {
  objects.erase(
      std::remove_if(objects.begin(), objects.end(), [](const Members& members) { return members.empty(); }),
      objects.end());
}

/// What the flights tell together: means and covariances.
struct MapEstimate {
  struct Shared {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
  };
  struct Place {
    Eigen::Vector3d position;
    Eigen::Matrix3d covariance;
  };
  std::vector<Shared> flights;
  std::vector<Place> objects;
};

/// Least squares over all flights, exact: objects and each flight's shared errors, which are N(0, I) by
/// themselves. Objects are eliminated first, since no two of them have noise in common, and what is left is
/// one dense system for the shared errors of flights that are connected by objects.
MapEstimate solve_map(const std::vector<FlightModel>& flights, const std::vector<Members>& objects);

}  // namespace geoloc
