// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "fleet/flight_model.hpp"
#include "geoloc/fleet/flight_summary.hpp"

namespace geoloc {

/// What the parts of a flight tell of its unknowns: constants, which all of them have in common, and the
/// drift at the ends of each, which goes on from one to the next. Everything is in units of what was expected
/// before the flight, and counted from where the first part that has the unknown believes it to be.
class FlightUnknowns {
 public:
  /// A part's unknowns by its errors: v(places) = mean + rows s with s ~ N(0, I).
  struct OfPart {
    std::vector<Eigen::Index> places;
    Eigen::VectorXd mean;
    Eigen::MatrixXd rows;
    Eigen::MatrixXd information;  ///< (rows rows')^-1
  };

  struct Solution {
    Eigen::VectorXd mean;
    Eigen::MatrixXd root;  ///< R, with R R' the covariance
    /// Logarithm of how much likelier the parts are where they are of one flight than otherwise.
    double log_likelihood_ratio;
  };

  /// The part that follows in time. `model`: that of its summary, whose last error is home's height.
  void add(const FlightSummary& summary, const FlightModel& model);

  const std::vector<OfPart>& parts() const { return parts_; }

  /// What all parts tell together; nullopt where they leave no solution.
  std::optional<Solution> solve();

 private:
  static constexpr std::size_t kHome = kFlightUnknowns, kKinds = kFlightUnknowns + 1;
  /// Where the unknowns of a part stand, by their kinds.
  using Places = std::array<std::optional<Eigen::Index>, kKinds>;
  struct Entry {
    std::size_t kind;
    FlightState::Unknown unknown;
    bool is_constant;
  };

  Eigen::Index append(const FlightState::Unknown& unknown);
  void multiply_by_prior(Eigen::Index place, const FlightState::Unknown& unknown, double power);
  void continue_drift(const FlightSummary& before, const FlightSummary& summary, const Places& places);
  void add_information(const OfPart& part);

  std::vector<OfPart> parts_;
  std::vector<double> references_, units_;
  std::vector<std::optional<FlightState::Unknown>> priors_;  // of the constants: the widest, not yet counted
  Places constants_;
  Places last_;  // of the part before
  const FlightSummary* before_ = nullptr;
  // exp(log_scale - v' information v / 2 + vector' v)
  Eigen::MatrixXd information_;
  Eigen::VectorXd vector_;
  double log_scale_ = 0.0;
};

}  // namespace geoloc
