// SPDX-License-Identifier: Apache-2.0
#include "fleet/relative_objects.hpp"

namespace geoloc {

RelativeObjects relative_objects(const FlightModel& flight, double sigma_object_m) {
  const Eigen::Matrix2d of_object = sigma_object_m * sigma_object_m * Eigen::Matrix2d::Identity();
  const Eigen::Matrix<double, 2, Eigen::Dynamic> shift = flight.shift.topRows<2>();
  const std::size_t count = flight.objects.size();
  RelativeObjects relative;
  relative.shift_covariance = shift * shift.transpose();
  relative.deformation.resize(2 * static_cast<Eigen::Index>(count), flight.unknowns());
  for (std::size_t i = 0; i < count; ++i) {
    auto rows = relative.deformation.middleRows<2>(2 * static_cast<Eigen::Index>(i));
    rows = flight.shared_of(i).topRows<2>() - shift;
    relative.positions.emplace_back(flight.objects[i].position.head<2>());
    relative.own_covariances.emplace_back(flight.objects[i].own_covariance.topLeftCorner<2, 2>() + of_object);
    relative.covariances.emplace_back(relative.own_covariances.back() + rows * rows.transpose());
  }
  return relative;
}

}  // namespace geoloc
