// SPDX-License-Identifier: Apache-2.0
#include "tracking/gated_components.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <queue>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace geoloc {
namespace {

constexpr double kLimit = 1.0;

using Component = std::pair<std::vector<int>, std::vector<int>>;  // rows, columns

std::set<Component> found(const Eigen::MatrixXd& costs) {
  GatedComponents components;
  components.find(costs, kLimit);
  std::set<Component> all;
  for (std::size_t k = 0; k < components.size(); ++k) {
    const auto rows = components.rows(k), columns = components.columns(k);
    all.insert({{rows.begin(), rows.end()}, {columns.begin(), columns.end()}});
  }
  EXPECT_EQ(all.size(), components.size());
  return all;
}

/// By walking from each row to whatever can be reached.
std::set<Component> by_walking(const Eigen::MatrixXd& costs) {
  std::set<Component> all;
  for (int start = 0; start < costs.rows(); ++start) {
    std::set<int> rows{start}, columns;
    std::queue<int> to_visit({start});
    for (; !to_visit.empty(); to_visit.pop()) {
      for (int j = 0; j < costs.cols(); ++j) {
        if (!(costs(to_visit.front(), j) < kLimit) || !columns.insert(j).second) continue;
        for (int i = 0; i < costs.rows(); ++i)
          if (costs(i, j) < kLimit && rows.insert(i).second) to_visit.push(i);
      }
    }
    if (!columns.empty()) all.insert({{rows.begin(), rows.end()}, {columns.begin(), columns.end()}});
  }
  return all;
}

TEST(GatedComponents, AreWhatCanBeReached) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const double pairs_per_row : {0.3, 1.0, 1.5, 4.0}) {
    for (const auto& [rows, columns] : {std::pair{20, 30}, {30, 20}, {1, 9}, {9, 1}, {25, 25}}) {
      Eigen::MatrixXd costs(rows, columns);
      for (double& cost : costs.reshaped())
        cost = uniform(random) < pairs_per_row / columns ? 0.5 : kLimit + uniform(random);
      EXPECT_EQ(found(costs), by_walking(costs)) << rows << " x " << columns << ", " << pairs_per_row;
    }
  }
}

TEST(GatedComponents, WhatIsNotANumberConnectsNothing) {
  EXPECT_TRUE(found(Eigen::MatrixXd::Constant(3, 3, std::numeric_limits<double>::quiet_NaN())).empty());
}

TEST(GatedComponents, OfNothingThereAreNone) {
  EXPECT_TRUE(found(Eigen::MatrixXd(0, 4)).empty());
  EXPECT_TRUE(found(Eigen::MatrixXd(4, 0)).empty());
}

}  // namespace
}  // namespace geoloc
