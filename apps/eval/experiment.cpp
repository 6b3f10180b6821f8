// SPDX-License-Identifier: Apache-2.0
#include "eval/experiment.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <mutex>

#include "common/replay.hpp"
#include "common/run_score.hpp"
#include "eval/parallel.hpp"
#include "eval/survey.hpp"
#include "geoloc/geometry/angles.hpp"
#include "geoloc/sim/flight/flight.hpp"
#include "geoloc/sim/flight/scenario.hpp"
#include "geoloc/sim/live/rangefinder.hpp"

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
                               camera.carrier_from_camera.rotation);
  const Eigen::Vector3d injected_rad = wrap_to_pi(turn.angle()) * turn.axis();
  using Index = CalibrationIndex;
  CalibrationError error;
  const double latency_at_end_s = run.errors.latency_s + run.errors.clock_step_s;
  error.injected_latency_s = latency_at_end_s;
  error.injected_boresight_deg = injected_rad.head<2>() * kDegPerRad;
  error.latency_s = estimated->latency_s() - latency_at_end_s;
  error.sigma_latency_s = estimated->sigma(Index::kLatency);
  error.boresight_deg = (estimated->boresight_rad() - injected_rad).head<2>() * kDegPerRad;
  error.sigma_boresight_deg =
      Eigen::Vector2d(estimated->sigma(Index::kBoresight), estimated->sigma(Index::kBoresight + 1)) *
      kDegPerRad;
  if (estimated->has_unknown_focal()) {
    error.focal_percent = estimated->focal_percent() - run.errors.focal_percent;
    error.sigma_focal_percent = estimated->sigma_focal_percent();
  }
  return error;
}

/// The objects of known points: those that stand for a target which is not scored.
LeftOut objects_of_known_points(const Session& session, const Survey& survey) {
  std::vector<io::TrueTarget> all = survey.others;
  all.insert(all.end(), survey.told.begin(), survey.told.end());
  const Score score = score_run(session, all);
  LeftOut ids;
  std::size_t object = 0;
  for (const Track& track : session.geolocator().tracks()) {
    if (track.status != TrackStatus::kConfirmed) continue;
    const auto target = score.target_of_object[object++];
    if (target && *target >= survey.others.size()) ids.push_back(track.id);
  }
  return ids;
}

int known_points_used(const Session& session) {
  const auto& entries = session.geolocator().known_points();
  return static_cast<int>(std::count_if(entries.begin(), entries.end(), [](const KnownPointMatch& entry) {
    return entry.status == KnownPointStatus::kMatched;
  }));
}

std::vector<Eigen::Vector2d> places_of(const std::vector<io::TrueTarget>& targets, const LocalFrame& frame) {
  std::vector<Eigen::Vector2d> places;
  for (const io::TrueTarget& target : targets)
    places.push_back(frame.to_local(target.position).position_in_enu.head<2>());
  return places;
}

/// The target that an object is a look-alike of: a point taken for its neighbour moves all objects, so that
/// the map as a whole must tell which one this is. It fits the targets best if moved from the object to its
/// own.
std::size_t target_by_map(const Eigen::Vector2d& object, const std::vector<Eigen::Vector2d>& objects,
                          const std::vector<Eigen::Vector2d>& targets) {
  constexpr double kReach_m = 5.0, kFit_m = 0.5;
  std::size_t best = targets.size();
  double best_misfit_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Eigen::Vector2d shift = targets[i] - object;
    if (shift.norm() > kReach_m) continue;
    double misfit_m2 = 0.0;
    for (const Eigen::Vector2d& other : objects) {
      double nearest_m2 = kFit_m * kFit_m;
      for (const Eigen::Vector2d& target : targets)
        nearest_m2 = std::min(nearest_m2, (other + shift - target).squaredNorm());
      misfit_m2 += nearest_m2;
    }
    if (misfit_m2 < best_misfit_m2) best = i;
    best_misfit_m2 = std::min(best_misfit_m2, misfit_m2);
  }
  return best;
}

int known_points_mistaken(const Session& session, const Survey& survey) {
  if (survey.points.empty() || !session.geolocator().local_frame()) return 0;
  std::vector<io::TrueTarget> all = survey.told;
  all.insert(all.end(), survey.others.begin(), survey.others.end());
  const auto targets = places_of(all, *session.geolocator().local_frame());
  std::vector<Eigen::Vector2d> objects;
  for (const Track& track : session.geolocator().tracks()) {
    if (track.status == TrackStatus::kConfirmed) objects.push_back(track.position_in_enu.mean);
  }
  int mistaken = 0;
  const auto& entries = session.geolocator().known_points();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].status != KnownPointStatus::kMatched) continue;
    for (const Track& track : session.geolocator().tracks()) {
      if (track.id == entries[i].track_id)
        mistaken += target_by_map(track.position_in_enu.mean, objects, targets) == i ? 0 : 1;
    }
  }
  return mistaken;
}

void run_task(const Experiment& experiment, const Task& task, std::vector<RunResult>& results) {
  sim::RecordingSettings settings = experiment.recording;
  settings.run.scenario = task.scenario;
  settings.run.seed = task.seed;
  const std::optional<sim::Flight> equipped = better_equipped(*task.flight, settings, experiment);
  const sim::Flight& flight = equipped ? *equipped : *task.flight;
  const LocalFrame& frame = flight.truth.frame();
  const auto targets_in_enu = sim::make_scenario(task.scenario, task.seed);
  const auto frames = sim::generate_frames(flight, settings, targets_in_enu);
  const auto truth = sim::true_targets(sim::standing_on(settings.terrain, targets_in_enu), frame);
  const EstimationConfig estimation = estimation_over(settings.terrain, frame, experiment);
  for (std::size_t m = 0; m < experiment.contenders.size(); ++m) {
    results[task.first_result + m] =
        run_method({flight, settings.run, frames, truth, true}, experiment.contenders[m], estimation);
  }
}

}  // namespace

std::optional<sim::Flight> better_equipped(const sim::Flight& recorded,
                                           const sim::RecordingSettings& settings,
                                           const Experiment& experiment) {
  if (!experiment.has_rangefinder) return std::nullopt;
  return sim::with_rangefinder(recorded, settings.terrain, sim::run_seed(settings.run, recorded));
}

EstimationConfig estimation_over(const sim::Terrain& terrain, const LocalFrame& frame,
                                 const Experiment& experiment) {
  EstimationConfig estimation = experiment.estimation;
  if (experiment.dem_spacing_m) {
    estimation.geolocator.terrain = std::make_shared<const HeightGrid>(
        sim::elevation_model(terrain, frame, *experiment.dem_spacing_m, sim::Site{}.ground_height_msl_m));
  }
  return estimation;
}

RunResult run_method(const SimulatedRun& run, const Contender& contender, EstimationConfig config) {
  const LocalFrame& frame = run.flight.truth.frame();
  const Survey survey =
      make_survey(run.truth, contender.known_points, sim::run_seed(run.settings, run.flight), frame);
  config.geolocator.camera = sim::nominal_camera(run.settings);
  config.geolocator.method = contender.method;
  config.geolocator.known_points = survey.points;
  Session session(config);
  RunProgress progress;
  replay(run.flight.telemetry, run.frames, session, [&](const PendingFrame& pending, bool) {
    if (run.wants_progress) progress.observe(session, pending.captured_at, run.truth);
    return true;
  });
  RunResult result;
  result.progress = progress.samples();
  result.flight = run.flight.name;
  result.scenario = run.settings.scenario;
  result.seed = run.settings.seed;
  result.contender = contender;
  const LeftOut told = objects_of_known_points(session, survey);
  result.score = score_run(session, survey.others, told);
  result.heights = score_heights_of_run(session, survey.others, result.score, told);
  result.nees = mean_nees_of_run(session, survey.others, result.score, told);
  result.known_points_used = known_points_used(session);
  result.known_points_mistaken = known_points_mistaken(session, survey);
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
        tasks.push_back({&flight, scenario, seed, tasks.size() * experiment.contenders.size()});
      }
    }
  }
  std::vector<RunResult> results(tasks.size() * experiment.contenders.size());
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
