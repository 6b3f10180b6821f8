// SPDX-License-Identifier: Apache-2.0
#include "calibration/flight_state.hpp"

#include <cmath>
#include <cstdint>

namespace geoloc {
namespace {

/// A component that is known better than that before the flight is no unknown.
constexpr double kKnown = 1e-8;

struct Gatherer {
  const ArrowheadSolver::Solution& solution;
  FlightState& state;

  void add(const FlightState::Unknown& unknown, const Eigen::RowVectorXd& shared_error) {
    const Eigen::Index row = state.shared_error.rows();
    state.unknowns.push_back(unknown);
    state.shared_error.conservativeResize(row + 1, solution.size_of_head());
    state.shared_error.row(row) = shared_error;
  }

  void add_constants(const Calibration& prior, bool has_latency) {
    const CalibrationVector mean = solution.calibration().mean;
    for (int i = 0; i < CalibrationIndex::kSize; ++i) {
      if (prior.sigma(i) <= kKnown || (i == CalibrationIndex::kLatency && !has_latency)) continue;
      add({static_cast<FlightUnknown>(i), mean[i], prior.mean[i], prior.sigma(i)},
          solution.shared_error_of_calibration(i));
    }
  }

  void add_node(FlightUnknown first, const DriftTimeline& drift, std::uint32_t number) {
    const NodeVector mean = solution.node(number), variance = drift.stationary_variance(number);
    for (int i = 0; i < kNodeSize; ++i)
      add({static_cast<FlightUnknown>(static_cast<int>(first) + i), mean[i], 0.0, std::sqrt(variance[i])},
          solution.shared_error_of_node(number, i));
  }
};

/// The node that the drift began at, as far as it is kept: after a reboot it began anew.
std::uint32_t first_node(const DriftTimeline& drift) {
  std::uint32_t first = drift.end() - 1;
  while (first != drift.begin() && drift.node(first).transition.maxCoeff() > 0.0) --first;
  return first;
}

}  // namespace

FlightState flight_state(const ArrowheadSolver& solver, const ArrowheadSolver::Solution& solution,
                         const SharedErrorEstimate& errors) {
  FlightState state;
  state.shared_error.resize(0, solution.size_of_head());
  const DriftConfig& config = errors.drift.config();
  state.drift = {config.position_time_constant_s, config.ripple_share, config.ripple_time_constant_s,
                 config.up_time_constant_s, config.yaw_time_constant_s};
  Gatherer gatherer{solution, state};
  gatherer.add_constants(solver.prior(errors.prior()), !errors.latency_prior);
  if (errors.drift.size() == 0) return state;
  const std::uint32_t first = first_node(errors.drift), last = errors.drift.end() - 1;
  state.first_node_at = errors.drift.node(first).time;
  state.last_node_at = errors.drift.node(last).time;
  if (errors.drift.node(first).serial == 0)
    gatherer.add_node(FlightUnknown::kFirstDriftEast, errors.drift, first);
  if (last != first) gatherer.add_node(FlightUnknown::kLastDriftEast, errors.drift, last);
  return state;
}

}  // namespace geoloc
