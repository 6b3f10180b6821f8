// SPDX-License-Identifier: Apache-2.0
#include "eval/experiment.hpp"

#include <Eigen/Geometry>
#include <mutex>

#include "common/replay.hpp"
#include "common/run_outputs.hpp"
#include "eval/parallel.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geoloc/sim/flight.hpp"
#include "geoloc/sim/scenario.hpp"

namespace geoloc::apps {
namespace {

/// One recording, replayed by each method.
struct Task {
  const sim::Flight* flight;
  int scenario;
  std::uint64_t seed;
  std::size_t first_result;  // of as many as there are methods
};

std::optional<CalibrationError> calibration_error(const Session& session, const sim::RunSettings& run,
                                                  const sim::Flight& flight) {
  const auto estimated = session.geolocator().calibration();
  if (!estimated) return std::nullopt;
  const sim::TrueCamera camera = sim::make_true_camera(run, sim::run_seed(run, flight));
  const Eigen::AngleAxisd turn(body_from_camera(sim::nominal_camera(run).mount).rotation.conjugate() *
                               camera.body_from_camera.rotation);
  const Eigen::Vector3d injected_rad = wrap_to_pi(turn.angle()) * turn.axis();
  using Index = CalibrationIndex;
  CalibrationError error;
  error.injected_latency_s = run.errors.latency_s;
  error.injected_boresight_deg = injected_rad.head<2>() * kDegPerRad;
  error.latency_s = estimated->latency_s() - run.errors.latency_s;
  error.sigma_latency_s = estimated->sigma(Index::kLatency);
  error.boresight_deg = (estimated->boresight_rad() - injected_rad).head<2>() * kDegPerRad;
  error.sigma_boresight_deg =
      Eigen::Vector2d(estimated->sigma(Index::kBoresight), estimated->sigma(Index::kBoresight + 1)) *
      kDegPerRad;
  return error;
}

void run_task(const Experiment& experiment, const Task& task, std::vector<RunResult>& results) {
  sim::RecordingSettings settings = experiment.recording;
  settings.run.scenario = task.scenario;
  settings.run.seed = task.seed;
  const auto targets_in_enu = sim::make_scenario(task.scenario, task.seed);
  const auto frames = sim::generate_frames(*task.flight, settings, targets_in_enu);
  const auto truth = sim::true_targets(targets_in_enu, task.flight->truth.frame());

  for (std::size_t m = 0; m < experiment.methods.size(); ++m) {
    results[task.first_result + m] =
        run_method({*task.flight, settings.run, frames, truth}, experiment.methods[m], experiment.estimation);
  }
}

}  // namespace

RunResult run_method(const SimulatedRun& run, Method method, EstimationConfig config) {
  config.geolocator.camera = sim::nominal_camera(run.settings);
  config.geolocator.method = method;
  Session session(config);
  replay(run.flight.telemetry, run.frames, session);
  RunResult result;
  result.flight = run.flight.name;
  result.scenario = run.settings.scenario;
  result.seed = run.settings.seed;
  result.method = method;
  result.score = score_run(session, run.truth);
  result.nees = consistency_of_run(session, run.truth, result.score);
  result.calibration = calibration_error(session, run.settings, run.flight);
  return result;
}

std::vector<RunResult> run_experiment(
    const Experiment& experiment, unsigned threads,
    const std::function<void(std::size_t done, std::size_t total)>& on_run) {
  std::vector<sim::Flight> flights;
  for (const std::string& name : experiment.flights) {
    flights.push_back(sim::load_flight(experiment.flights_folder, name));
  }
  std::vector<Task> tasks;
  for (const sim::Flight& flight : flights) {
    for (const int scenario : experiment.scenarios) {
      for (const std::uint64_t seed : experiment.seeds) {
        tasks.push_back({&flight, scenario, seed, tasks.size() * experiment.methods.size()});
      }
    }
  }
  std::vector<RunResult> results(tasks.size() * experiment.methods.size());
  std::mutex progress_mutex;
  std::size_t done = 0;
  parallel_for(tasks.size(), threads, [&](std::size_t i) {
    run_task(experiment, tasks[i], results);
    const std::lock_guard lock(progress_mutex);
    on_run(++done, tasks.size());
  });
  return results;
}

}  // namespace geoloc::apps
