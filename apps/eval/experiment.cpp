// SPDX-License-Identifier: Apache-2.0
#include "eval/experiment.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "common/replay.hpp"
#include "common/run_outputs.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geoloc/sim/flight.hpp"
#include "geoloc/sim/random.hpp"
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
  error.latency_s = estimated->latency_s() - run.errors.latency_s;
  error.sigma_latency_s = estimated->sigma(Index::kLatency);
  error.boresight_deg = (estimated->boresight_rad() - injected_rad).head<2>() * kDegPerRad;
  error.sigma_boresight_deg =
      Eigen::Vector2d(estimated->sigma(Index::kBoresight), estimated->sigma(Index::kBoresight + 1)) *
      kDegPerRad;
  return error;
}

/// Some of the targets as a survey gives them, 5 cm off (1-sigma, an axis), and the rest, which are scored.
struct Survey {
  std::vector<KnownPoint> points;
  std::vector<io::TrueTarget> told;
  std::vector<io::TrueTarget> others;
};

Survey survey(std::vector<io::TrueTarget> targets, int count, std::uint64_t seed, const LocalFrame& frame) {
  constexpr double kSigma_m = 0.05;
  sim::Random random(seed);
  Survey survey;
  for (int i = 0; i < count && !targets.empty(); ++i) {
    const auto chosen = targets.begin() + random.index(static_cast<int>(targets.size()));
    const Eigen::Vector2d error = kSigma_m * Eigen::Vector2d(random.normal(), random.normal());
    KnownPoint point;
    point.name = std::to_string(chosen->id);
    point.position = frame.to_geodetic(frame.to_local(chosen->position).position_in_enu + error);
    point.sigma_m = kSigma_m;
    survey.points.push_back(point);
    survey.told.push_back(*chosen);
    targets.erase(chosen);
  }
  survey.others = std::move(targets);
  return survey;
}

/// The objects of known points: those that stand for a target which is not scored.
LeftOut objects_of_known_points(const Session& session, const Survey& known) {
  std::vector<io::TrueTarget> all = known.others;
  all.insert(all.end(), known.told.begin(), known.told.end());
  const Score score = score_run(session, all);
  LeftOut ids;
  std::size_t object = 0;
  for (const Track& track : session.geolocator().tracks()) {
    if (track.status != TrackStatus::kConfirmed) continue;
    if (score.target_of_object[object++] >= static_cast<int>(known.others.size())) ids.push_back(track.id);
  }
  return ids;
}

int known_points_used(const Session& session) {
  const auto& entries = session.geolocator().known_points();
  return static_cast<int>(std::count_if(entries.begin(), entries.end(), [](const KnownPoints::Entry& entry) {
    return entry.status == KnownPointStatus::kMatched;
  }));
}

void run_task(const Experiment& experiment, const Task& task, std::vector<RunResult>& results) {
  sim::RecordingSettings settings = experiment.recording;
  settings.run.scenario = task.scenario;
  settings.run.seed = task.seed;
  const auto targets_in_enu = sim::make_scenario(task.scenario, task.seed);
  const auto frames = sim::generate_frames(*task.flight, settings, targets_in_enu);
  const LocalFrame& frame = task.flight->truth.frame();

  for (std::size_t m = 0; m < experiment.methods.size(); ++m) {
    EstimationConfig config = experiment.estimation;
    config.geolocator.camera = sim::nominal_camera(settings.run);
    config.geolocator.method = experiment.methods[m];
    const bool is_told = config.geolocator.method == Method::kFull;
    const Survey known =
        survey(sim::true_targets(targets_in_enu, frame), is_told ? experiment.known_points : 0,
               sim::run_seed(settings.run, *task.flight), frame);
    config.geolocator.known_points = known.points;
    Session session(config);
    replay(task.flight->telemetry, frames, session);
    RunResult& result = results[task.first_result + m];
    result.flight = task.flight->name;
    result.scenario = task.scenario;
    result.seed = task.seed;
    result.method = experiment.methods[m];
    const LeftOut told = objects_of_known_points(session, known);
    result.score = score_run(session, known.others, told);
    result.nees = consistency_of_run(session, known.others, result.score, told);
    result.known_points_used = known_points_used(session);
    result.calibration = calibration_error(session, settings.run, *task.flight);
  }
}

/// Runs step(i) for i below `count` on several threads; the first exception is passed on.
void parallel_for(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& step) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        step(i);
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> crew;
  for (unsigned i = 1; i < threads; ++i) crew.emplace_back(work);
  work();
  for (std::thread& member : crew) member.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace

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
