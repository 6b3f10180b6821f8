// SPDX-License-Identifier: Apache-2.0
// The estimator's time per frame: the whole of process(), the projection and the assignment alone, and the
// state buffer.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "geoloc/pipeline/geolocator.hpp"
#include "geoloc/projection/projector.hpp"
#include "geoloc/state/state_buffer.hpp"
#include "geoloc/tracking/assignment.hpp"

namespace {

using namespace geoloc;
using namespace std::chrono_literals;

constexpr VehicleTime kStart{60s};
constexpr double kHeight_m = 140.0;  // a thousand objects are in the image
constexpr double kSpacing_m = 3.0;   // beyond gate and merging distance

/// Adds telemetry of a vehicle that hovers level with its nose to the north.
void hover(Geolocator& geolocator, VehicleTime time) {
  geolocator.add(AttitudeSample{time, {}});
  PositionSample position;
  position.time = time;
  position.position = {-22.906, -43.133};
  position.height_above_home_m = kHeight_m;
  geolocator.add(position);
}

/// Boxes of objects that stand in a square grid around the point below the vehicle.
std::vector<Detection> grid_of_detections(int count, double focal_px) {
  const double spacing_px = kSpacing_m / kHeight_m * focal_px;
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  std::vector<Detection> detections;
  for (int i = 0; i < count; ++i) {
    const int column = i % side, row = i / side;
    const double u = 639.5 + (column - 0.5 * (side - 1)) * spacing_px;
    const double v = 359.5 + (row - 0.5 * (side - 1)) * spacing_px;
    detections.push_back({{u - 4.0, v - 4.0, 8.0, 8.0}, 0.9, 0});
  }
  return detections;
}

/// One method with `detections` in a frame and `tracks`, all of them in view, at ten frames per second.
void process_frame(benchmark::State& state, Method method) {
  const auto detections = static_cast<std::size_t>(state.range(0));
  const int tracks = static_cast<int>(state.range(1));
  GeolocatorConfig config;
  config.method = method;
  config.max_detections = tracks;
  config.paper.max_penalty = 1'000'000'000;  // tracks that are not detected stay
  Geolocator geolocator(config);
  FrameDetections frame;
  frame.captured_at = kStart;
  frame.detections = grid_of_detections(tracks, config.camera.intrinsics.fx_px);
  hover(geolocator, kStart);
  const auto process_next = [&] {
    frame.captured_at += 100ms;
    hover(geolocator, frame.captured_at);
    benchmark::DoNotOptimize(geolocator.process(frame));
  };
  constexpr int kFramesToSettle = 200;  // the joint method solves after each frame at first
  for (int i = 0; i < kFramesToSettle; ++i) process_next();
  if (geolocator.tracks().size() != static_cast<std::size_t>(tracks))
    state.SkipWithError("not as many tracks");
  frame.detections.resize(detections);
  for (auto _ : state) process_next();
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(process_frame, paper, Method::kPaper)
    ->Args({30, 30})
    ->Args({100, 100})
    ->Args({10, 100})
    ->Args({1, 1000})
    ->Args({100, 1000})
    ->ArgNames({"detections", "tracks"});
// Cases with undetected tracks are left out: the joint method would remove these tracks.
BENCHMARK_CAPTURE(process_frame, joint, Method::kJoint)
    ->Args({30, 30})
    ->Args({100, 100})
    ->ArgNames({"detections", "tracks"});

/// Pixels of a lens with distortion, seen from 20 m, to the ground, with what a pixel's noise makes there.
void projection(benchmark::State& state) {
  const bool at_once = state.range(0) > 0;
  CameraIntrinsics lens;
  lens.distortion = {-0.2, 0.05, 0.001, -0.001, 0.01};
  const Projector projector(ProjectorConfig{}, lens);
  const Rigid3d enu_from_camera{Eigen::Quaterniond(0.02, 1.0, 0.03, 0.01).normalized(), {0.0, 0.0, 20.0}};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Eigen::Vector2d> pixels;
  for (int i = 0; i < 1000; ++i) pixels.emplace_back(1280.0 * share(random), 720.0 * share(random));
  std::vector<Expected<GroundFix, NoFix>> fixes;
  for (auto _ : state) {
    fixes.clear();
    if (at_once) {
      projector.project(pixels, enu_from_camera, fixes);
    } else {
      for (const Eigen::Vector2d& pixel : pixels) fixes.push_back(projector.project(pixel, enu_from_camera));
    }
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (const auto& fix : fixes) sum += fix->covariance(1.0);
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pixels.size()));
}
BENCHMARK(projection)->Arg(0)->Arg(1)->ArgName("at_once");

void assignment(benchmark::State& state) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 6.0);
  const Eigen::MatrixXd costs =
      Eigen::MatrixXd::NullaryExpr(state.range(0), state.range(1), [&] { return uniform(random); });
  AssignmentSolver solver;
  for (auto _ : state) {
    std::size_t first_column = solver.solve(costs, 3.0).front();
    benchmark::DoNotOptimize(first_column);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(assignment)->Args({30, 30})->Args({100, 1000})->ArgNames({"rows", "columns"});

void buffer_insert_and_look_up(benchmark::State& state) {
  StateBuffer<Eigen::Vector3d> buffer;
  VehicleTime now = kStart;
  for (auto _ : state) {
    now += 100ms;
    buffer.insert(now, Eigen::Vector3d::Ones());
    benchmark::DoNotOptimize(buffer.bracket(now - 150ms, 600ms, 5ms));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(buffer_insert_and_look_up);

}  // namespace
