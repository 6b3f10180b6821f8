// SPDX-License-Identifier: Apache-2.0
#include "tracking/joint_estimate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "calibration/flight_state.hpp"
#include "geometry/symmetric.hpp"

namespace geoloc {
namespace {

/// An object with the sums that tell where it is.
struct Found {
  Track track;
  Landmark landmark;
  const Neighbours* neighbours;
};

std::vector<Found> confirmed_objects(const JointState& state, DriftTimeline& drift) {
  std::vector<Found> found;
  for (const RestingObject& object : state.awake) {
    if (object.is_confirmed()) found.push_back({object.track, *object.landmark, &object.neighbours});
  }
  state.sleeping.for_each(drift,
                          [&](std::uint64_t id, const Landmark& landmark, const Neighbours& neighbours) {
                            const Track* const track = state.published.find(id);
                            if (track != nullptr && track->status == TrackStatus::kConfirmed)
                              found.push_back({*track, landmark, &neighbours});
                          });
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.track.id < b.track.id; });
  return found;
}

std::vector<const Landmark*> landmarks_of(const TrackTable& awake) {
  std::vector<const Landmark*> landmarks;
  for (const RestingObject& object : awake) landmarks.push_back(object.landmark);
  return landmarks;
}

JointEstimate::Object object_of(const Found& found, const SharedErrorEstimate& errors, double level_m,
                                const PointMatrix& own, const PointMatrix& covariance) {
  JointEstimate::Object object;
  object.position_in_enu = own * found.landmark.weighted_position(errors.calibration.mean, errors.drift);
  object.position_in_enu.z() += level_m;
  object.own_covariance = symmetric(own);
  object.track = found.track;
  object.track.position_in_enu = {object.position_in_enu.head<2>(), covariance.topLeftCorner<2, 2>()};
  object.track.height = HeightEstimate{object.position_in_enu.z(), std::sqrt(covariance(2, 2))};
  return object;
}

void list_apart(const std::vector<Found>& found, JointEstimate& estimate) {
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    for (const std::uint64_t other : found[i].neighbours->apart()) {
      const auto place = std::lower_bound(found.begin(), found.end(), other,
                                          [](const Found& a, auto id) { return a.track.id < id; });
      if (place == found.end() || place->track.id != other) continue;
      const auto k = static_cast<std::uint32_t>(place - found.begin());
      if (k != i) estimate.apart.emplace_back(std::min(i, k), std::max(i, k));
    }
  }
  std::sort(estimate.apart.begin(), estimate.apart.end());
  estimate.apart.erase(std::unique(estimate.apart.begin(), estimate.apart.end()), estimate.apart.end());
}

}  // namespace

std::optional<JointEstimate> joint_estimate(const JointState& state, double ground_height_above_home_m) {
  ArrowheadSolver solver = state.solver;
  SharedErrorEstimate errors = state.errors;
  const auto solution = solver.solve(landmarks_of(state.awake), errors.prior(), errors.drift, state.heights,
                                     &state.sleeping.settled());
  if (!solution) return std::nullopt;
  JointEstimate estimate;
  estimate.flight_state = flight_state(solver, *solution, errors);
  errors.take(*solution);
  const double level_m = ground_height_above_home_m - errors.calibration.height_m();
  const std::vector<Found> found = confirmed_objects(state, errors.drift);

  estimate.shared_error.setZero(static_cast<Eigen::Index>(kPointSize * found.size()),
                                solution->size_of_head());
  for (std::size_t i = 0; i < found.size(); ++i) {
    auto shared = estimate.shared_error.middleRows<kPointSize>(static_cast<Eigen::Index>(kPointSize * i));
    shared = solution->shared_error(found[i].landmark);
    const PointMatrix own = found[i].landmark.A().inverse();
    const PointMatrix covariance = own + shared * shared.transpose();
    estimate.objects.push_back(object_of(found[i], errors, level_m, own, covariance));
  }
  list_apart(found, estimate);
  return estimate;
}

}  // namespace geoloc
