// SPDX-License-Identifier: Apache-2.0
#include "fleet/relative_objects.hpp"

namespace geoloc {

RelativeObjects relative_objects(const FlightModel& flight, const FlightPart& part, double sigma_object_m) {
  const Eigen::Matrix2d of_object = sigma_object_m * sigma_object_m * Eigen::Matrix2d::Identity();
  const Eigen::Matrix<double, 2, Eigen::Dynamic> shift = part.shift.topRows<2>();
  const std::size_t count = part.objects;
  RelativeObjects relative;
  relative.shift_covariance = shift * shift.transpose();
  relative.deformation.resize(2 * static_cast<Eigen::Index>(count), flight.unknowns());
  for (std::size_t i = 0; i < count; ++i) {
    auto rows = relative.deformation.middleRows<2>(2 * static_cast<Eigen::Index>(i));
    const ModelObject& object = flight.objects[part.first_object + i];
    rows = flight.shared_of(part.first_object + i).topRows<2>() - shift;
    relative.positions.emplace_back(object.position.head<2>());
    relative.own_covariances.emplace_back(object.own_covariance.topLeftCorner<2, 2>() + of_object);
    relative.covariances.emplace_back(relative.own_covariances.back() + rows * rows.transpose());
  }
  return relative;
}

}  // namespace geoloc
