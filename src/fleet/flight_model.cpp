// SPDX-License-Identifier: Apache-2.0
#include "fleet/flight_model.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "geometry/symmetric.hpp"

namespace geoloc {

FlightModel model_of(const FlightSummary& summary, Eigen::Index most_shared, double sigma_home_m) {
  const Eigen::Index kept = std::min(summary.shared_count(), most_shared);
  const Eigen::Index dropped = summary.shared_count() - kept;
  FlightModel model;
  model.shared.setZero(summary.shared_error.rows(), kept + 1);
  model.shared.leftCols(kept) = summary.shared_error.leftCols(kept);
  model.objects.reserve(summary.objects.size());
  for (std::size_t i = 0; i < summary.objects.size(); ++i) {
    const FlightSummary::Object& object = summary.objects[i];
    const auto rest = summary.shared_error_of(i).rightCols(dropped);
    const Eigen::Matrix3d own = symmetric(object.own_covariance + rest * rest.transpose());
    model.objects.push_back({object.position_in_enu, own, symmetric(own.inverse())});
    model.shared(3 * static_cast<Eigen::Index>(i) + 2, kept) = sigma_home_m;
  }
  model.shift.setZero(3, kept + 1);
  model.shift.leftCols(kept) = common_shift(summary).leftCols(kept);
  model.shift(2, kept) = sigma_home_m;
  return model;
}

}  // namespace geoloc
