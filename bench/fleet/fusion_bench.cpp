// SPDX-License-Identifier: Apache-2.0
// The time that a fleet's map takes, where every flight saw every object: the dearest case.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geoloc/fleet/fusion.hpp"

namespace {

using namespace geoloc;

constexpr double kSpacing_m = 8.0;
constexpr double kOffset_m = 0.7, kOwn_m = 0.1, kYaw_rad = 0.002;

/// Objects of a square grid, each moved a little so that the grid fits itself nowhere else.
std::vector<Eigen::Vector3d> targets(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> off(-3.0, 3.0);
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < count; ++i) {
    const int row = i / side, column = i % side;
    places.emplace_back(kSpacing_m * column + off(random), kSpacing_m * row + off(random), 0.0);
  }
  return places;
}

FlightSummary draw_flight(int number, const std::vector<Eigen::Vector3d>& places, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Eigen::Vector4d s(normal(random), normal(random), normal(random), normal(random));
  FlightSummary summary;
  summary.identity = {"flight-" + std::to_string(number), "", 1};
  summary.origin = {47.0, 8.0};
  summary.shared_error.setZero(3 * static_cast<Eigen::Index>(places.size()), 4);
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto shared = summary.shared_error.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    shared.leftCols<3>().diagonal().setConstant(kOffset_m);
    shared.col(3) << kYaw_rad * places[i].y(), -kYaw_rad * places[i].x(), 0.0;
    FlightSummary::Object object;
    object.id = i + 1;
    object.position_in_enu =
        places[i] - shared * s - kOwn_m * Eigen::Vector3d(normal(random), normal(random), normal(random));
    object.own_covariance = kOwn_m * kOwn_m * Eigen::Matrix3d::Identity();
    object.hits = 10;
    object.existence = 0.99;
    object.class_votes.add(0, 1.0);
    summary.objects.push_back(object);
  }
  return summary;
}

void fuse_fleet(benchmark::State& state) {
  std::mt19937 random(1);
  const auto places = targets(static_cast<int>(state.range(1)), random);
  Fleet fleet;
  for (int i = 0; i < state.range(0); ++i) take(draw_flight(i, places, random), fleet);
  std::size_t objects = 0;
  for (auto _ : state) objects = fuse(fleet).objects.size();
  state.counters["objects"] = static_cast<double>(objects);
  if (objects != places.size()) state.SkipWithError("not as many objects as targets");
}
BENCHMARK(fuse_fleet)
    ->Args({8, 30})
    ->Args({100, 300})
    ->Args({1000, 300})
    ->Args({1000, 1000})
    ->ArgNames({"flights", "objects"})
    ->Unit(benchmark::kMillisecond);

}  // namespace
