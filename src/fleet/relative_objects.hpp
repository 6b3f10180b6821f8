// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fleet/fleet_flight.hpp"

namespace geoloc {

/// Objects of a part of a flight as they lie among each other, horizontally [m]: what all are off by together
/// is apart.
struct RelativeObjects {
  using RowsOfAll = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  std::vector<Eigen::Vector2d> positions;
  std::vector<Eigen::Matrix2d> own_covariances;
  std::vector<Eigen::Matrix2d> covariances;  ///< that of the deformation included
  RowsOfAll deformation;                     ///< two rows per object, a column per shared error
  Eigen::Matrix2d shift_covariance;          ///< of what is apart
};

/// `sigma_object_m`: of an object seen from different directions.
RelativeObjects relative_objects(const FlightModel& flight, const FlightPart& part, double sigma_object_m);

}  // namespace geoloc
