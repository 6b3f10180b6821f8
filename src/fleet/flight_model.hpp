// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "geoloc/fleet/flight_summary.hpp"

namespace geoloc {

/// An object of a flight as the fusion takes it: at position + shared s + noise [m].
struct ModelObject {
  Eigen::Vector3d position;
  Eigen::Matrix3d own_covariance;
  Eigen::Matrix3d own_information;  ///< its inverse
};

/// A flight as the fusion takes it, in the fleet's frame: with no more shared errors than the fusion can
/// afford, and with one more, by which the height of its home is off.
struct FlightModel {
  std::vector<ModelObject> objects;
  Eigen::MatrixXd shared;                          ///< three rows per object, a column per error [m]
  Eigen::Matrix<double, 3, Eigen::Dynamic> shift;  ///< how all objects move per error, in the mean

  Eigen::Index unknowns() const { return shared.cols(); }
  auto shared_of(std::size_t object) const {
    return shared.middleRows<3>(3 * static_cast<Eigen::Index>(object));
  }
};

/// `summary`: in the fleet's frame, its heights above the fleet's home, give or take sigma_home_m. Of its
/// shared errors the first `most_shared` are kept; the others become noise of each object by itself.
FlightModel model_of(const FlightSummary& summary, Eigen::Index most_shared, double sigma_home_m);

}  // namespace geoloc
