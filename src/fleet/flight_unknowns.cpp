// SPDX-License-Identifier: Apache-2.0
#include "fleet/flight_unknowns.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "fleet/fewer_errors.hpp"
#include "fleet/flight_parts.hpp"
#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

constexpr int kDriftSize = 4;
/// The least share of the drift's variance that is new from one part to the next, however near they are.
constexpr double kLeastInnovation = 1e-9;
const double kLog2Pi = std::log(2.0 * kPi);

/// Between the drift's values `apart_s` from each other.
double correlation(const DriftCorrelation& drift, int component, double apart_s) {
  const auto after = [&](double time_constant_s) { return std::exp(-apart_s / time_constant_s); };
  switch (component) {
    case 0:
    case 1:
      return (1.0 - drift.ripple_share) * after(drift.position_time_constant_s) +
             drift.ripple_share * after(drift.ripple_time_constant_s);
    case 2:
      return after(drift.up_time_constant_s);
    default:
      return after(drift.yaw_time_constant_s);
  }
}

/// The unknowns' rows, by the errors of the part's model, of home's height, and of the unknowns alone.
Eigen::MatrixXd rows_of(const FlightState& state, const FlightModel& model) {
  const Eigen::Index kept = model.unknowns() - 1;
  const Eigen::MatrixXd fewer = with_fewer_errors(state.shared_error, kept);
  const Eigen::Index others = fewer.cols() - kept;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(fewer.rows() + 1, fewer.cols() + 1);
  rows.topLeftCorner(fewer.rows(), kept) = fewer.leftCols(kept);
  rows.topRightCorner(fewer.rows(), others) = fewer.rightCols(others);
  rows(fewer.rows(), kept) = model.shift(2, kept);
  return rows;
}

}  // namespace

Eigen::Index FlightUnknowns::append(const FlightState::Unknown& unknown) {
  const auto place = static_cast<Eigen::Index>(units_.size());
  references_.push_back(unknown.mean);
  units_.push_back(unknown.prior_sigma);
  priors_.emplace_back();
  information_.conservativeResize(place + 1, place + 1);
  information_.row(place).setZero();
  information_.col(place).setZero();
  vector_.conservativeResize(place + 1);
  vector_[place] = 0.0;
  return place;
}

/// A Gaussian of the unknown, as often as `power` says: -1 divides by it.
void FlightUnknowns::multiply_by_prior(Eigen::Index place, const FlightState::Unknown& unknown,
                                       double power) {
  const auto i = static_cast<std::size_t>(place);
  const double mean = (unknown.prior_mean - references_[i]) / units_[i];
  const double information = std::pow(units_[i] / unknown.prior_sigma, 2);
  information_(place, place) += power * information;
  vector_[place] += power * information * mean;
  log_scale_ -= 0.5 * power * (information * mean * mean + kLog2Pi - std::log(information));
}

/// The drift is what it was at the end of the part before, as far as it is correlated: p(b | a) / p(b).
void FlightUnknowns::continue_drift(const FlightSummary& before, const FlightSummary& summary,
                                    const Places& places) {
  const FlightState& state = summary.part->state;
  const double apart_s = std::abs(seconds(host_time(summary.part->run, state.first_node_at) -
                                          host_time(before.part->run, before.part->state.last_node_at)));
  for (int component = 0; component < kDriftSize; ++component) {
    const auto at = static_cast<std::size_t>(component);
    const auto last = last_[static_cast<std::size_t>(FlightUnknown::kLastDriftEast) + at];
    const auto first = places[static_cast<std::size_t>(FlightUnknown::kFirstDriftEast) + at];
    if (!last || !first) continue;
    const auto i = static_cast<std::size_t>(*first), k = static_cast<std::size_t>(*last);
    const auto drift = std::find_if(state.unknowns.begin(), state.unknowns.end(), [&](const auto& unknown) {
      return static_cast<int>(unknown.which) == static_cast<int>(FlightUnknown::kFirstDriftEast) + component;
    });
    multiply_by_prior(*first, *drift, -1.0);
    // Both count from their means; before the flight they are zero, with the same variance.
    const double kept = correlation(state.drift, component, apart_s);
    const double innovation = std::max(1.0 - kept * kept, kLeastInnovation);
    const double target = kept * references_[k] / units_[k] - references_[i] / units_[i];
    information_(*first, *first) += 1.0 / innovation;
    information_(*last, *last) += kept * kept / innovation;
    information_(*first, *last) -= kept / innovation;
    information_(*last, *first) -= kept / innovation;
    vector_[*first] += target / innovation;
    vector_[*last] -= kept * target / innovation;
    log_scale_ -= 0.5 * (target * target / innovation + kLog2Pi + std::log(innovation));
  }
}

void FlightUnknowns::add_information(const OfPart& part) {
  const Eigen::VectorXd weighted = part.information * part.mean;
  for (std::size_t i = 0; i < part.places.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    vector_[part.places[i]] += weighted[row];
    for (std::size_t k = 0; k < part.places.size(); ++k)
      information_(part.places[i], part.places[k]) += part.information(row, static_cast<Eigen::Index>(k));
  }
  const Eigen::MatrixXd root = part.information.llt().matrixL();
  log_scale_ += root.diagonal().array().log().sum() -
                0.5 * (part.mean.dot(weighted) + static_cast<double>(part.mean.size()) * kLog2Pi);
}

void FlightUnknowns::add(const FlightSummary& summary, const FlightModel& model) {
  const FlightState& state = summary.part->state;
  const double sigma_home_m = model.shift(2, model.unknowns() - 1);
  std::vector<Entry> entries;
  for (const FlightState::Unknown& unknown : state.unknowns)
    entries.push_back({static_cast<std::size_t>(unknown.which), unknown, is_constant(unknown.which)});
  const bool has_home =
      before_ == nullptr || before_->home_height_msl_m.has_value() == summary.home_height_msl_m.has_value();
  entries.push_back({kHome, {{}, 0.0, 0.0, sigma_home_m}, has_home});

  OfPart part;
  part.rows = rows_of(state, model);
  part.mean.resize(part.rows.rows());
  Places places;
  for (std::size_t row = 0; row < entries.size(); ++row) {
    const Entry& entry = entries[row];
    const bool is_shared = entry.is_constant && constants_[entry.kind];
    const Eigen::Index place = is_shared ? *constants_[entry.kind] : append(entry.unknown);
    if (entry.is_constant) {
      multiply_by_prior(place, entry.unknown, -1.0);
      std::optional<FlightState::Unknown>& widest = priors_[static_cast<std::size_t>(place)];
      if (!widest || widest->prior_sigma < entry.unknown.prior_sigma) widest = entry.unknown;
      constants_[entry.kind] = place;
    }
    places[entry.kind] = place;
    part.places.push_back(place);
    const auto i = static_cast<std::size_t>(place);
    const auto at = static_cast<Eigen::Index>(row);
    part.rows.row(at) /= units_[i];
    part.mean[at] = (entry.unknown.mean - references_[i]) / units_[i];
  }
  const Eigen::Index size = part.mean.size();
  part.information = (part.rows * part.rows.transpose()).llt().solve(Eigen::MatrixXd::Identity(size, size));
  part.information = (0.5 * (part.information + part.information.transpose())).eval();
  add_information(part);
  if (before_ != nullptr) continue_drift(*before_, summary, places);
  parts_.push_back(std::move(part));
  last_ = places;
  before_ = &summary;
}

/// What all parts began with counts once: as the part believed that knew least.
std::optional<FlightUnknowns::Solution> FlightUnknowns::solve() {
  for (std::size_t i = 0; i < priors_.size(); ++i) {
    if (priors_[i]) multiply_by_prior(static_cast<Eigen::Index>(i), *priors_[i], 1.0);
    priors_[i].reset();
  }
  const Eigen::LLT<Eigen::MatrixXd> root(information_);
  if (root.info() != Eigen::Success || !information_.allFinite()) return std::nullopt;
  const Eigen::Index size = vector_.size();
  Solution solution;
  solution.mean = root.solve(vector_);
  solution.root = root.matrixU().solve(Eigen::MatrixXd::Identity(size, size));
  solution.log_likelihood_ratio = log_scale_ + 0.5 * vector_.dot(solution.mean) +
                                  0.5 * static_cast<double>(size) * kLog2Pi -
                                  Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum();
  if (!solution.mean.allFinite() || !solution.root.allFinite() ||
      !std::isfinite(solution.log_likelihood_ratio))
    return std::nullopt;
  return solution;
}

}  // namespace geoloc
