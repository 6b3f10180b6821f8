// SPDX-License-Identifier: Apache-2.0
#include "fleet/map_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "fleet/lower_inverse.hpp"
#include "fleet/synthetic_fleet.hpp"

namespace geoloc {
namespace {

using testing::clustered_targets;
using testing::draw_flight;

/// The same by generalised least squares over all positions at once, with their full covariance: another way
/// to the same numbers, in which nothing is eliminated.
MapEstimate by_full_covariance(const std::vector<FlightModel>& flights, const std::vector<Members>& objects) {
  Eigen::Index rows = 0;
  for (const Members& members : objects) rows += 3 * static_cast<Eigen::Index>(members.size());
  const auto unknowns = 3 * static_cast<Eigen::Index>(objects.size());
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(rows, unknowns),
                  covariance = Eigen::MatrixXd::Zero(rows, rows);
  Eigen::VectorXd reported(rows);
  std::vector<Contribution> of_row;
  for (std::size_t k = 0; k < objects.size(); ++k) {
    for (const Contribution& member : objects[k]) {
      const auto at = 3 * static_cast<Eigen::Index>(of_row.size());
      design.block<3, 3>(at, 3 * static_cast<Eigen::Index>(k)).setIdentity();
      reported.segment<3>(at) = flights[member.flight].objects[member.object].position;
      of_row.push_back(member);
    }
  }
  for (std::size_t a = 0; a < of_row.size(); ++a) {
    for (std::size_t b = 0; b < of_row.size(); ++b) {
      if (of_row[a].flight != of_row[b].flight) continue;
      const FlightModel& flight = flights[of_row[a].flight];
      auto block = covariance.block<3, 3>(3 * static_cast<Eigen::Index>(a), 3 * static_cast<Eigen::Index>(b));
      block = flight.shared_of(of_row[a].object) * flight.shared_of(of_row[b].object).transpose();
      if (a == b) block += flight.objects[of_row[a].object].own_covariance;
    }
  }
  const Eigen::MatrixXd weighted = covariance.ldlt().solve(design);
  const Eigen::MatrixXd posterior = (design.transpose() * weighted).inverse();
  const Eigen::VectorXd mean = posterior * (weighted.transpose() * reported);
  MapEstimate estimate;
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const auto at = 3 * static_cast<Eigen::Index>(k);
    estimate.objects.push_back({mean.segment<3>(at), posterior.block<3, 3>(at, at)});
  }
  return estimate;
}

struct Case {
  std::vector<FlightModel> flights;
  std::vector<Members> objects;
};

/// Flights that each saw a share of the targets. Every flight of an odd number has one error less.
Case draw_case(std::size_t flights, std::size_t targets, double share, unsigned seed) {
  std::mt19937 random(seed);
  const auto places = clustered_targets(targets, random);
  Case drawn;
  drawn.objects.resize(targets);
  for (std::size_t f = 0; f < flights; ++f) {
    const FlightSummary whole = draw_flight("a", places, {}, random);
    FlightSummary seen = whole;
    seen.objects.clear();
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < targets; ++i) {
      if (std::uniform_real_distribution<double>()(random) >= share) continue;
      drawn.objects[i].push_back({f, seen.objects.size()});
      seen.objects.push_back(whole.objects[i]);
      for (Eigen::Index k = 0; k < 3; ++k) rows.push_back(3 * static_cast<Eigen::Index>(i) + k);
    }
    seen.shared_error = whole.shared_error(rows, Eigen::all);
    drawn.flights.push_back(model_of(seen, f % 2 == 0 ? 4 : 3, 2.0));
  }
  drawn.objects.erase(std::remove_if(drawn.objects.begin(), drawn.objects.end(),
                                     [](const Members& members) { return members.empty(); }),
                      drawn.objects.end());
  return drawn;
}

void expect_same(const MapEstimate& a, const MapEstimate& b) {
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_LT((a.objects[i].position - b.objects[i].position).norm(), 1e-8) << i;
    EXPECT_LT((a.objects[i].covariance - b.objects[i].covariance).norm(), 1e-8) << i;
  }
}

TEST(MapSolver, IsLeastSquaresWithTheFullCovariance) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    for (const double share : {0.15, 0.5, 1.0}) {
      const Case drawn = draw_case(9, 24, share, seed);
      expect_same(solve_map(drawn.flights, drawn.objects), by_full_covariance(drawn.flights, drawn.objects));
    }
  }
}

/// Objects in batches, and covariances by the root of the system rather than by its inverse.
TEST(MapSolver, IsTheSameForMoreObjectsThanABatch) {
  const Case drawn = draw_case(2, 135, 1.0, 3);
  expect_same(solve_map(drawn.flights, drawn.objects), by_full_covariance(drawn.flights, drawn.objects));
}

TEST(MapSolver, TakesTwoObjectsOfOneFlightForOne) {
  Case drawn = draw_case(4, 12, 0.8, 5);
  drawn.objects[0].insert(drawn.objects[0].end(), drawn.objects[1].begin(), drawn.objects[1].end());
  drawn.objects.erase(drawn.objects.begin() + 1);
  expect_same(solve_map(drawn.flights, drawn.objects), by_full_covariance(drawn.flights, drawn.objects));
}

TEST(MapSolver, AFlightAloneIsAsItSays) {
  const Case drawn = draw_case(1, 12, 1.0, 6);
  const MapEstimate estimate = solve_map(drawn.flights, drawn.objects);
  for (std::size_t i = 0; i < drawn.objects.size(); ++i) {
    const auto shared = drawn.flights[0].shared_of(i);
    EXPECT_EQ(estimate.objects[i].position, drawn.flights[0].objects[i].position);
    EXPECT_LT((estimate.objects[i].covariance - shared * shared.transpose() -
               drawn.flights[0].objects[i].own_covariance)
                  .norm(),
              1e-12);
  }
}

TEST(InverseOfLower, TimesItIsOne) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const Eigen::Index size : {1, 5, 96, 97, 250}) {
    Eigen::MatrixXd lower(size, size);
    for (Eigen::Index i = 0; i < lower.size(); ++i) lower(i) = 0.1 * normal(random);
    lower.diagonal().array() += 3.0;
    const Eigen::MatrixXd product =
        Eigen::MatrixXd(lower.triangularView<Eigen::Lower>()) * inverse_of_lower(lower);
    EXPECT_LT((product - Eigen::MatrixXd::Identity(size, size)).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace geoloc
