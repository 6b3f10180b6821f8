// SPDX-License-Identifier: Apache-2.0
#include "fleet/common_errors.hpp"

#include <Eigen/LU>

namespace geoloc {
namespace {

/// Others that tell a thousandth of what the flight itself knows of its shift tell nothing.
constexpr double kLeastShareTold = 1e-3;

/// With prior N(0, P) and posterior N(m, C) of the shift, what the others say by themselves differs from the
/// prior's mean by a residual whose chi-square is m' (P - C)^-1 m.
double chi2_against_others(const Eigen::Vector2d& mean, const Eigen::Matrix2d& prior,
                           const Eigen::Matrix2d& posterior) {
  const Eigen::Matrix2d told = prior - posterior;
  if (!(told.determinant() > kLeastShareTold * kLeastShareTold * prior.determinant())) return 0.0;
  return mean.dot(told.inverse() * mean);
}

/// Flights that share an object with each, counted up to two: whether there is another, and a third.
void count_others(const std::vector<Members>& objects, std::vector<CommonError>& errors) {
  std::vector<std::size_t> another(errors.size(), errors.size());
  for (const Members& members : objects) {
    if (members.size() < 2) continue;
    for (const Contribution& member : members) {
      CommonError& error = errors[member.flight];
      ++error.shared_objects;
      for (const Contribution& other : members) {
        if (error.other_flights == 2) break;
        if (other.flight == member.flight || other.flight == another[member.flight]) continue;
        another[member.flight] = other.flight;
        ++error.other_flights;
      }
    }
  }
}

}  // namespace

std::vector<CommonError> common_errors(const std::vector<FlightModel>& flights,
                                       const std::vector<Members>& objects, const MapEstimate& estimate) {
  std::vector<CommonError> errors(flights.size());
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const auto& shift = flights[i].shift;
    const MapEstimate::Shared& shared = estimate.flights[i];
    const Eigen::Vector3d moved = shift * shared.mean;
    const Eigen::Matrix3d prior = shift * shift.transpose();
    const Eigen::Matrix3d posterior = shift * shared.covariance * shift.transpose();
    errors[i].mean_m = Eigen::Vector3d::Zero() - moved;  // never minus zero
    errors[i].sigma_m = posterior.diagonal().cwiseMax(0.0).cwiseSqrt();
    errors[i].chi2 =
        chi2_against_others(moved.head<2>(), prior.topLeftCorner<2, 2>(), posterior.topLeftCorner<2, 2>());
  }
  count_others(objects, errors);
  return errors;
}

}  // namespace geoloc
