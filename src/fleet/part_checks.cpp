// SPDX-License-Identifier: Apache-2.0
#include "fleet/part_checks.hpp"

#include <Eigen/Cholesky>
#include <chrono>
#include <cmath>
#include <cstddef>

namespace geoloc {
namespace {

constexpr double kMostValue = 1e6, kLeastPriorSigma = 1e-9;
constexpr double kMostTimeConstant_s = 1e9;
/// What an unknown is off by besides all others, of what was expected of it: below, they are not independent.
constexpr double kLeastIndependence = 1e-7;
/// Times that can be added: of a boot, and since then.
constexpr auto kMostAge = std::chrono::hours{24 * 365 * 100}, kMostUptime = std::chrono::hours{24 * 365};

bool is_value(double value) {
  return std::abs(value) <= kMostValue;  // NaN is not
}

bool is_time_constant(double value_s) {
  return value_s > 0.0 && value_s <= kMostTimeConstant_s;
}

template <typename Time>
bool is_within(Time time, Duration most) {
  return time.time_since_epoch() >= -most && time.time_since_epoch() <= most;
}

bool are_times(const FlightRun& run, const FlightState& state) {
  return is_within(run.booted_at, kMostAge) && is_within(run.ended_at, kMostUptime) &&
         is_within(state.first_node_at, kMostUptime) && is_within(state.last_node_at, kMostUptime) &&
         state.first_node_at <= state.last_node_at;
}

bool are_in_order(const std::vector<FlightState::Unknown>& unknowns) {
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (static_cast<std::size_t>(unknowns[i].which) >= kFlightUnknowns) return false;
    if (i > 0 && !(unknowns[i - 1].which < unknowns[i].which)) return false;
  }
  return true;
}

bool have_values(const FlightState& state) {
  for (const FlightState::Unknown& unknown : state.unknowns) {
    if (!is_value(unknown.mean) || !is_value(unknown.prior_mean)) return false;
    if (!(unknown.prior_sigma >= kLeastPriorSigma && unknown.prior_sigma <= kMostValue)) return false;
  }
  return state.shared_error.size() == 0 ||
         (state.shared_error.allFinite() && state.shared_error.cwiseAbs().maxCoeff() <= kMostValue);
}

bool are_independent(const FlightState& state) {
  if (state.unknowns.empty()) return true;
  Eigen::MatrixXd rows = state.shared_error;
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    rows.row(i) /= state.unknowns[static_cast<std::size_t>(i)].prior_sigma;
  const Eigen::LLT<Eigen::MatrixXd> root(rows * rows.transpose());
  return root.info() == Eigen::Success && root.matrixLLT().diagonal().minCoeff() >= kLeastIndependence;
}

bool is_correlation(const DriftCorrelation& drift) {
  return is_time_constant(drift.position_time_constant_s) && is_time_constant(drift.ripple_time_constant_s) &&
         is_time_constant(drift.up_time_constant_s) && is_time_constant(drift.yaw_time_constant_s) &&
         drift.ripple_share >= 0.0 && drift.ripple_share <= 1.0;
}

}  // namespace

void check_part(const FlightSummary::Part& part, Eigen::Index shared_count, NamedFaults& faults) {
  const FlightState& state = part.state;
  faults.require(part.run.whole.empty() || is_flight_name(part.run.whole),
                 "the whole flight's name must be at most 64 letters, digits, or any of - _ . :");
  faults.require(are_times(part.run, state),
                 "its times must be within a year of a boot in this century or the last, the first node's "
                 "before the last one's");
  faults.require(is_correlation(state.drift),
                 "the drift's time constants must be above 0, and its ripple's share between 0 and 1");
  const bool fits = state.shared_error.rows() == static_cast<Eigen::Index>(state.unknowns.size()) &&
                    state.shared_error.cols() >= shared_count &&
                    state.shared_error.cols() <= shared_count + static_cast<Eigen::Index>(kFlightUnknowns);
  faults.require(fits, "its shared errors must have a row per unknown, and the columns of the objects'");
  faults.require(are_in_order(state.unknowns), "its unknowns must be in their order, each once");
  const bool is_finite = have_values(state);
  faults.require(is_finite, "its unknowns must be within 1e6, their sigmas before the flight above 1e-9");
  if (fits && is_finite)
    faults.require(are_independent(state), "its unknowns' covariance must be positive definite");
}

}  // namespace geoloc
