// SPDX-License-Identifier: Apache-2.0
#include "fleet/joined_parts.hpp"

#include <Eigen/QR>
#include <utility>

#include "fleet/flight_unknowns.hpp"

namespace geoloc {
namespace {

/// Summaries of one boot are of one flight, unless they say otherwise as strongly as this.
constexpr double kLeastLogLikelihoodRatio = -7.0;

/// The errors of a part by those of the whole flight, s = mean + by_unknowns z + by_own y, z of the flight's
/// unknowns, y of what is left of the part's: as many rows as the part's model has errors.
struct Substitution {
  Eigen::VectorXd mean;
  Eigen::MatrixXd by_unknowns;
  Eigen::MatrixXd by_own;
};

/// What the unknowns leave open of the errors is orthogonal to their rows, and as it was.
Substitution substitution(const FlightUnknowns::OfPart& part, const FlightUnknowns::Solution& solution,
                          Eigen::Index errors) {
  const Eigen::MatrixXd inverse = (part.rows.transpose() * part.information).topRows(errors);
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(part.rows.transpose());
  const Eigen::MatrixXd basis = factors.householderQ();
  const Eigen::VectorXd mean = solution.mean(part.places) - part.mean;
  const Eigen::MatrixXd root = solution.root(part.places, Eigen::all);
  return {inverse * mean, inverse * root, basis.rightCols(basis.cols() - part.mean.size()).topRows(errors)};
}

double weight_of(const FlightModel& model) {
  double weight = 0.0;
  for (const ModelObject& object : model.objects)
    weight += 1.0 / object.own_covariance.topLeftCorner<2, 2>().trace();
  return weight;
}

class Joiner {
 public:
  Joiner(Eigen::Index unknowns, Eigen::Index errors, Eigen::Index objects) : next_own_(unknowns) {
    joined_.model.shared.setZero(3 * objects, errors);
    joined_.model.shift.setZero(3, errors);
  }

  void add(const PartModel& part, const Substitution& by) {
    const FlightModel& model = part.model;
    const auto first = joined_.model.objects.size();
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(first);
    joined_.model.shared.middleRows(row, model.shared.rows()) = substituted(model.shared, by);
    const Eigen::VectorXd moved = model.shared * by.mean;
    for (std::size_t i = 0; i < model.objects.size(); ++i) {
      joined_.model.objects.push_back(model.objects[i]);
      joined_.model.objects.back().position += moved.segment<3>(3 * static_cast<Eigen::Index>(i));
    }
    joined_.parts.push_back(
        {part.number, first, model.objects.size(), substituted(model.shift, by), model.shift * by.mean});
    const double weight = weight_of(model);
    joined_.model.shift += weight * joined_.parts.back().shift;
    weight_ += weight;
    next_own_ += by.by_own.cols();
  }

  FleetFlight take() {
    if (weight_ > 0.0) joined_.model.shift /= weight_;
    return std::move(joined_);
  }

 private:
  Eigen::MatrixXd substituted(const Eigen::MatrixXd& rows, const Substitution& by) const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows.rows(), joined_.model.shift.cols());
    all.leftCols(by.by_unknowns.cols()) = rows * by.by_unknowns;
    all.middleCols(next_own_, by.by_own.cols()) = rows * by.by_own;
    return all;
  }

  FleetFlight joined_;
  Eigen::Index next_own_;
  double weight_ = 0.0;
};

}  // namespace

std::optional<FleetFlight> join_parts(const std::vector<PartModel>& parts) {
  FlightUnknowns unknowns;
  for (const PartModel& part : parts) unknowns.add(part.summary, part.model);
  const auto solution = unknowns.solve();
  if (!solution || solution->log_likelihood_ratio < kLeastLogLikelihoodRatio) return std::nullopt;
  std::vector<Substitution> substitutions;
  Eigen::Index errors = solution->mean.size(), objects = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    substitutions.push_back(substitution(unknowns.parts()[i], *solution, parts[i].model.unknowns()));
    errors += substitutions.back().by_own.cols();
    objects += static_cast<Eigen::Index>(parts[i].model.objects.size());
  }
  Joiner joiner(solution->mean.size(), errors, objects);
  for (std::size_t i = 0; i < parts.size(); ++i) joiner.add(parts[i], substitutions[i]);
  return joiner.take();
}

}  // namespace geoloc
