// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <utility>

#include "fleet/fewer_errors.hpp"
#include "geoloc/fleet/flight_summary.hpp"
#include "geometry/symmetric.hpp"

namespace geoloc {
namespace {

/// A shared error is kept where it changes the variance of any combination of positions by more than this
/// share of what their own noise makes it.
constexpr double kLeastEffect = 1e-3;
constexpr Eigen::Index kShift = 3;

FlightSummary::Object object_of(const JointEstimate::Object& estimate) {
  FlightSummary::Object object;
  object.id = estimate.track.id;
  object.position_in_enu = estimate.position_in_enu;
  object.own_covariance = estimate.own_covariance;
  object.hits = estimate.track.hits;
  object.existence = estimate.track.existence.value_or(1.0);
  object.class_votes = estimate.track.class_votes;
  object.first_seen = estimate.track.first_seen;
  object.last_seen = estimate.track.last_seen;
  return object;
}

/// An orthogonal matrix V by which the shared errors are mixed anew, so that the first three alone move all
/// objects together.
Eigen::MatrixXd shift_first(const FlightSummary& summary) {
  const Eigen::Matrix<double, 3, Eigen::Dynamic> shift = common_shift(summary);
  return Eigen::HouseholderQR<Eigen::MatrixXd>(shift.transpose()).householderQ();
}

/// Shared errors from `first` on, each position in units of its own noise.
Eigen::MatrixXd whitened(const FlightSummary& summary, Eigen::Index first) {
  Eigen::MatrixXd white = summary.shared_error.rightCols(summary.shared_count() - first);
  for (std::size_t i = 0; i < summary.objects.size(); ++i) {
    auto rows = white.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    const Eigen::Matrix3d root = summary.objects[i].own_covariance.llt().matrixL();
    rows = root.triangularView<Eigen::Lower>().solve(rows.eval()).eval();
  }
  return white;
}

/// The last columns become the objects' own noise, and errors of the flight's state by itself.
void drop_after(Eigen::Index kept, FlightSummary& summary) {
  const Eigen::Index dropped = summary.shared_count() - kept;
  for (std::size_t i = 0; i < summary.objects.size(); ++i) {
    const Eigen::Matrix<double, 3, Eigen::Dynamic> rows = summary.shared_error_of(i).rightCols(dropped);
    summary.objects[i].own_covariance += symmetric(rows * rows.transpose());
  }
  summary.shared_error = summary.shared_error.leftCols(kept).eval();
  if (summary.part)
    summary.part->state.shared_error = with_fewer_errors(summary.part->state.shared_error, kept);
}

/// Those that only deform are sorted by their effect, and those of next to none are dropped.
void sort_deformations(FlightSummary& summary) {
  const Eigen::Index count = summary.shared_count() - kShift;
  const Eigen::MatrixXd white = whitened(summary, kShift);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> effects(white.transpose() * white);
  const Eigen::MatrixXd turn = effects.eigenvectors().rowwise().reverse();
  summary.shared_error.rightCols(count) = (summary.shared_error.rightCols(count) * turn).eval();
  if (summary.part) {
    auto of_state = summary.part->state.shared_error.rightCols(count);
    of_state = (of_state * turn).eval();
  }
  const auto& values = effects.eigenvalues();  // rising
  const Eigen::Index told = (values.array() > kLeastEffect).count();
  drop_after(std::min(kShift + told, FlightSummary::kMostShared), summary);
}

}  // namespace

FlightSummary summarize(const JointEstimate& estimate, FlightIdentity identity, const Geodetic& origin,
                        std::optional<double> home_height_msl_m, std::optional<FlightRun> run) {
  FlightSummary summary;
  summary.identity = std::move(identity);
  summary.origin = origin;
  summary.home_height_msl_m = home_height_msl_m;
  for (const JointEstimate::Object& object : estimate.objects) summary.objects.push_back(object_of(object));
  summary.shared_error = estimate.shared_error;
  summary.apart = estimate.apart;
  if (run) summary.part = FlightSummary::Part{*std::move(run), estimate.flight_state};
  if (summary.objects.empty()) {
    drop_after(0, summary);
    return summary;
  }
  if (summary.shared_count() <= kShift) return summary;
  const Eigen::MatrixXd turn = shift_first(summary);
  summary.shared_error = (summary.shared_error * turn).eval();
  if (summary.part) summary.part->state.shared_error = (estimate.flight_state.shared_error * turn).eval();
  sort_deformations(summary);
  return summary;
}

}  // namespace geoloc
