// SPDX-License-Identifier: Apache-2.0
#include "fleet/common_errors.hpp"

#include <Eigen/LU>
#include <algorithm>

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

bool are_of_one_flight(const Members& members) {
  return std::all_of(members.begin(), members.end(),
                     [&](const Contribution& member) { return member.flight == members.front().flight; });
}

PartError& error_of_part(const FusionInput& input, const Contribution& member, CommonError& error) {
  const std::vector<FlightPart>& parts = input.parts[member.flight];
  return error.parts[static_cast<std::size_t>(&input.part_of(member) - parts.data())];
}

/// Flights that share an object with each, counted up to two: whether there is another, and a third.
void count_others(const FusionInput& input, const std::vector<Members>& objects,
                  std::vector<CommonError>& errors) {
  std::vector<std::size_t> another(errors.size(), errors.size());
  for (const Members& members : objects) {
    if (are_of_one_flight(members)) continue;
    for (const Contribution& member : members) {
      CommonError& error = errors[member.flight];
      ++error_of_part(input, member, error).shared_objects;
      for (const Contribution& other : members) {
        if (error.other_flights == 2) break;
        if (other.flight == member.flight || other.flight == another[member.flight]) continue;
        another[member.flight] = other.flight;
        ++error.other_flights;
      }
    }
  }
}

PartError part_error(const FlightPart& part, const MapEstimate::Shared& shared) {
  const Eigen::Vector3d moved = part.moved + part.shift * shared.mean;
  const Eigen::Matrix3d covariance = part.shift * shared.covariance * part.shift.transpose();
  return {Eigen::Vector3d::Zero() - moved,  // never minus zero
          covariance.diagonal().cwiseMax(0.0).cwiseSqrt(), 0};
}

}  // namespace

std::vector<CommonError> common_errors(const FusionInput& input, const std::vector<Members>& objects,
                                       const MapEstimate& estimate) {
  std::vector<CommonError> errors(input.models.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const auto& shift = input.models[i].shift;
    const MapEstimate::Shared& shared = estimate.flights[i];
    const Eigen::Vector3d moved = shift * shared.mean;
    const Eigen::Matrix3d prior = shift * shift.transpose();
    const Eigen::Matrix3d posterior = shift * shared.covariance * shift.transpose();
    errors[i].mean_m = Eigen::Vector3d::Zero() - moved;
    errors[i].chi2 =
        chi2_against_others(moved.head<2>(), prior.topLeftCorner<2, 2>(), posterior.topLeftCorner<2, 2>());
    for (const FlightPart& part : input.parts[i]) errors[i].parts.push_back(part_error(part, shared));
  }
  count_others(input, objects, errors);
  return errors;
}

}  // namespace geoloc
