// SPDX-License-Identifier: Apache-2.0
#include "fleet/association.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "fleet/class_odds.hpp"
#include "fleet/map_places.hpp"
#include "fleet/relative_objects.hpp"
#include "fleet/shift_search.hpp"
#include "geoloc/tracking/assignment.hpp"
#include "tracking/gaussian.hpp"

namespace geoloc {
namespace {

/// Places of the flight's objects; nullopt: it is at none of the sheet's.
using Match = std::vector<std::optional<std::uint32_t>>;

/// How often objects are assigned, each time with a better estimate of how the flight is deformed.
constexpr int kAssignments = 3;
/// 1-sigma of what a shift that was found may be off by.
constexpr double kSigmaOfShift_m = 1.0;

/// The flight as it lies on the sheet: its objects moved and straightened.
struct Laid {
  std::vector<Eigen::Vector2d> positions;
  std::vector<Eigen::Matrix2d> covariances;
};

Laid laid_by_shift(const RelativeObjects& flight, const Eigen::Vector2d& shift) {
  Laid laid{flight.positions, flight.covariances};
  for (Eigen::Vector2d& position : laid.positions) position += shift;
  return laid;
}

/// Two rows per object, a column for each unknown of how the flight lies on a sheet: its shared errors, and
/// what the shift is off by.
RelativeObjects::RowsOfAll jacobian_of(const RelativeObjects& flight) {
  RelativeObjects::RowsOfAll jacobian(flight.deformation.rows(), flight.deformation.cols() + 2);
  jacobian.leftCols(flight.deformation.cols()) = flight.deformation;
  for (Eigen::Index row = 0; row < jacobian.rows(); row += 2)
    jacobian.bottomRightCorner(jacobian.rows() - row, 2).topRows<2>().setIdentity();
  return jacobian;
}

/// The flight by the places that its objects are at: least squares for what deforms it.
Laid straightened(const RelativeObjects& flight, const Eigen::Vector2d& shift, const Match& match,
                  const MapPlaces& places) {
  const RelativeObjects::RowsOfAll jacobian = jacobian_of(flight);
  const Eigen::Index unknowns = jacobian.cols();
  RelativeObjects::RowsOfAll white = RelativeObjects::RowsOfAll::Zero(jacobian.rows(), unknowns);
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(jacobian.rows());
  for (std::size_t i = 0; i < match.size(); ++i) {
    if (!match[i]) continue;
    const MapPlace& place = places[*match[i]];
    const auto row = 2 * static_cast<Eigen::Index>(i);
    const Eigen::Matrix2d root = (flight.own_covariances[i] + place.covariance()).llt().matrixL();
    const Eigen::Matrix2d whitening = root.inverse();
    white.middleRows<2>(row) = whitening.lazyProduct(jacobian.middleRows<2>(row));
    residual.segment<2>(row) = whitening * (place.position - flight.positions[i] - shift);
  }
  Eigen::MatrixXd information = Eigen::MatrixXd::Identity(unknowns, unknowns);
  information.bottomRightCorner<2, 2>() /= kSigmaOfShift_m * kSigmaOfShift_m;
  information += white.transpose() * white;
  const Eigen::MatrixXd covariance = information.llt().solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  const Eigen::VectorXd moved = jacobian * (covariance * (white.transpose() * residual));
  const RelativeObjects::RowsOfAll projected = jacobian * covariance;
  Laid laid;
  for (std::size_t i = 0; i < match.size(); ++i) {
    const auto row = 2 * static_cast<Eigen::Index>(i);
    laid.positions.emplace_back(flight.positions[i] + shift + moved.segment<2>(row));
    laid.covariances.emplace_back(flight.own_covariances[i] + projected.middleRows<2>(row).lazyProduct(
                                                                  jacobian.middleRows<2>(row).transpose()));
  }
  return laid;
}

/// A place within an object's gate, and what it costs to take the object for it.
struct Candidate {
  std::uint32_t key;
  double cost;
};

class Assigner {
 public:
  Assigner(const MapPlaces& places, const std::vector<int>& classes, double gate)
      : places_(places), classes_(classes), gate_(gate) {}

  /// Each object at the place that suits all of them best, each place once.
  Match assign(const Laid& laid, std::uint32_t sheet) {
    list_candidates(laid, sheet);
    Match match(laid.positions.size());
    std::vector<std::size_t> contested;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (candidates_[i].empty()) continue;
      if (candidates_[i].size() == 1 && wanted_[candidates_[i].front().key] == 1) {
        match[i] = candidates_[i][0].key;
      } else {
        contested.push_back(i);
      }
    }
    assign_contested(contested, match);
    return match;
  }

 private:
  void list_candidates(const Laid& laid, std::uint32_t sheet) {
    candidates_.resize(laid.positions.size());
    wanted_.assign(places_.size(), 0);
    for (std::size_t i = 0; i < laid.positions.size(); ++i) {
      candidates_[i].clear();
      const double reach_m = std::sqrt(gate_ * (laid.covariances[i].trace() + kMostVariance_m2));
      places_.for_each_near(laid.positions[i], reach_m, [&](std::uint32_t key) {
        const MapPlace& place = places_[key];
        if (place.sheet != sheet) return;
        const Eigen::Matrix2d covariance = laid.covariances[i] + place.covariance();
        const double chi2 =
            mahalanobis_squared(Eigen::Vector2d(place.position - laid.positions[i]), covariance);
        if (!(chi2 <= gate_)) return;
        candidates_[i].push_back({key, chi2 + 2.0 * class_penalty(classes_[i], place.class_id)});
        ++wanted_[key];
      });
    }
  }

  void assign_contested(const std::vector<std::size_t>& contested, Match& match) {
    if (contested.empty()) return;
    std::map<std::uint32_t, Eigen::Index> columns;
    for (const std::size_t i : contested) {
      for (const Candidate& candidate : candidates_[i]) columns.emplace(candidate.key, 0);
    }
    std::vector<std::uint32_t> keys;
    for (auto& [key, column] : columns) {
      column = static_cast<Eigen::Index>(keys.size());
      keys.push_back(key);
    }
    const double alone = gate_ + 2.0 * class_penalty(0, 1) + 1.0;
    Eigen::MatrixXd costs = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(contested.size()),
                                                      static_cast<Eigen::Index>(keys.size()), alone);
    for (std::size_t row = 0; row < contested.size(); ++row) {
      for (const Candidate& candidate : candidates_[contested[row]])
        costs(static_cast<Eigen::Index>(row), columns[candidate.key]) = candidate.cost;
    }
    const std::vector<std::size_t>& solution = solver_.solve(costs, alone);
    for (std::size_t row = 0; row < contested.size(); ++row) {
      if (solution[row] != AssignmentSolver::kUnassigned) match[contested[row]] = keys[solution[row]];
    }
  }

  static constexpr double kMostVariance_m2 = 2.0;  // of a place of the map, for the search
  const MapPlaces& places_;
  const std::vector<int>& classes_;
  double gate_;
  std::vector<std::vector<Candidate>> candidates_;  // of each object
  std::vector<int> wanted_;                         // by how many objects each place is
  AssignmentSolver solver_;
};

struct Placed {
  LaidFlight on;
  Laid laid;
  Match match;
};

Placed place_on(const LaidFlight& on, const AssociatedFlight& flight, const RelativeObjects& relative,
                const MapPlaces& places, double gate) {
  Placed placed{on, laid_by_shift(relative, on.shift), {}};
  Assigner assigner(places, flight.classes, gate);
  placed.match = assigner.assign(placed.laid, on.sheet);
  for (int i = 1; i < kAssignments; ++i) {
    placed.laid = straightened(relative, on.shift, placed.match, places);
    placed.match = assigner.assign(placed.laid, on.sheet);
  }
  return placed;
}

/// Joins the sheets that the flight lies on. An object of it that is at a place on each makes these one.
void join_sheets(std::vector<Placed>& placed, MapPlaces& places) {
  Placed& first = placed.front();
  for (std::size_t k = 1; k < placed.size(); ++k) {
    places.join(placed[k].on.sheet, first.on.sheet, first.on.shift - placed[k].on.shift);
    for (std::size_t i = 0; i < first.match.size(); ++i) {
      if (!placed[k].match[i]) continue;
      if (first.match[i]) {
        places.merge(*first.match[i], *placed[k].match[i]);
      } else {
        first.match[i] = placed[k].match[i];
      }
    }
  }
}

void add_to_map(const AssociatedFlight& flight, const Placed& placed, MapPlaces& places) {
  for (std::size_t i = 0; i < flight.classes.size(); ++i) {
    const Contribution member{flight.number, flight.part.first_object + i};
    const Eigen::Matrix2d information = placed.laid.covariances[i].inverse();
    if (placed.match[i]) {
      places.update(*placed.match[i], placed.laid.positions[i], information);
      places[*placed.match[i]].members.push_back(member);
    } else {
      places.add({placed.laid.positions[i], information, placed.on.sheet, flight.classes[i], {member}});
    }
  }
}

/// Most objects first, so that the map has them when flights of few are laid onto it.
std::vector<std::size_t> order_of(const std::vector<AssociatedFlight>& flights) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < flights.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return flights[a].classes.size() > flights[b].classes.size();
  });
  return order;
}

}  // namespace

std::vector<Members> associate(const std::vector<AssociatedFlight>& flights, const FusionConfig& config) {
  MapPlaces places;
  for (const std::size_t number : order_of(flights)) {
    const AssociatedFlight& flight = flights[number];
    const RelativeObjects relative = relative_objects(flight.model, flight.part, config.sigma_object_m);
    std::vector<Placed> placed;
    for (const LaidFlight& on : find_shifts(relative, flight.classes, places, config))
      placed.push_back(place_on(on, flight, relative, places, config.gate));
    if (placed.empty()) {
      const std::uint32_t sheet = places.new_sheet(relative.shift_covariance);
      placed.push_back(
          {{sheet}, laid_by_shift(relative, Eigen::Vector2d::Zero()), Match(flight.classes.size())});
    }
    join_sheets(placed, places);
    add_to_map(flight, placed.front(), places);
  }
  std::vector<Members> objects = places.take();
  for (Members& members : objects) {
    std::sort(members.begin(), members.end(), [](const Contribution& a, const Contribution& b) {
      return std::pair(a.flight, a.object) < std::pair(b.flight, b.object);
    });
  }
  std::sort(objects.begin(), objects.end(), [](const Members& a, const Members& b) {
    return std::pair(a.front().flight, a.front().object) < std::pair(b.front().flight, b.front().object);
  });
  return objects;
}

}  // namespace geoloc
