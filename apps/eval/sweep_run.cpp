// SPDX-License-Identifier: Apache-2.0
#include "eval/sweep_run.hpp"

#include <algorithm>
#include <mutex>

#include "eval/parallel.hpp"
#include "geoloc/sim/flight/scenario.hpp"

namespace geoloc::apps {
namespace {

/// Targets that stand wholly in three frames at least: no method can be expected to find others.
int targets_in_view(const sim::Flight& flight, const sim::RecordingSettings& settings,
                    const std::vector<Eigen::Vector3d>& targets_in_enu) {
  constexpr int kEnough = 3;
  const sim::TrueCamera camera = sim::make_true_camera(settings.run, sim::run_seed(settings.run, flight));
  const CameraModel model(camera.intrinsics);
  const sim::TimeSpan span = sim::run_span(settings.run, flight.truth);
  const Duration period = from_seconds(1.0 / settings.run.frame_rate_hz);
  std::vector<int> frames(targets_in_enu.size(), 0);
  for (VehicleTime time = span.begin; time <= span.end; time += period) {
    const Rigid3d camera_from_enu = (flight.truth.pose(time).value() * camera.carrier_from_camera).inverse();
    for (std::size_t i = 0; i < targets_in_enu.size(); ++i) {
      if (frames[i] >= kEnough) continue;
      if (sim::disc_in_image(model, camera_from_enu, targets_in_enu[i], settings.detector)) ++frames[i];
    }
  }
  return static_cast<int>(std::count(frames.begin(), frames.end(), kEnough));
}

/// A value of a sweep on one flight.
struct Step {
  std::size_t sweep;
  std::size_t point;
  const sim::Flight* recorded;
};

SweepPoint run_step(const Experiment& experiment, const Sweep& sweep, double value,
                    const sim::Flight& recorded) {
  std::optional<sim::Flight> variant;
  if (sweep.flight_at) variant.emplace(sweep.flight_at(recorded, value));
  const sim::Flight& flown = variant ? *variant : recorded;
  SweepPoint point{value, {}, 0};
  for (const std::uint64_t seed : experiment.seeds) {
    sim::RecordingSettings settings = experiment.recording;
    settings.run.scenario = 1;
    settings.run.seed = seed;
    if (sweep.apply) sweep.apply(value, flown, settings);
    const std::optional<sim::Flight> equipped = better_equipped(flown, settings, experiment);
    const sim::Flight& flight = equipped ? *equipped : flown;
    const auto targets_in_enu =
        sweep.targets_at ? sweep.targets_at(value, seed) : sim::make_scenario(1, seed);
    const auto frames = sim::generate_frames(flight, settings, targets_in_enu);
    const auto truth =
        sim::true_targets(sim::standing_on(settings.terrain, targets_in_enu), flight.truth.frame());
    EstimationConfig estimation = estimation_over(settings.terrain, flight.truth.frame(), experiment);
    if (sweep.configure) sweep.configure(value, estimation);
    for (const Contender& contender : experiment.contenders) {
      if (contender.known_points > 0) continue;
      point.runs.push_back(run_method({flight, settings.run, frames, truth}, contender, estimation));
    }
    if (sweep.leaves_targets_out)
      point.in_view += targets_in_view(flight, settings, sim::standing_on(settings.terrain, targets_in_enu));
  }
  return point;
}

void append(const SweepPoint& from, SweepPoint& to) {
  to.runs.insert(to.runs.end(), from.runs.begin(), from.runs.end());
  to.in_view += from.in_view;
}

}  // namespace

std::vector<SweepResult> run_sweeps(const Experiment& experiment, const std::vector<Sweep>& sweeps,
                                    unsigned threads,
                                    const std::function<void(std::size_t done, std::size_t total)>& on_step) {
  std::vector<sim::Flight> flights;
  for (const std::string& name : experiment.flights)
    flights.push_back(sim::load_flight(experiment.flights_folder, name));
  std::vector<Step> steps;
  for (std::size_t s = 0; s < sweeps.size(); ++s) {
    for (std::size_t p = 0; p < sweeps[s].values.size(); ++p) {
      for (const sim::Flight& flight : flights) steps.push_back({s, p, &flight});
    }
  }
  std::vector<SweepPoint> parts(steps.size());
  std::mutex progress_mutex;
  std::size_t done = 0;
  parallel_for(steps.size(), threads, [&](std::size_t i) {
    const Sweep& sweep = sweeps[steps[i].sweep];
    parts[i] = run_step(experiment, sweep, sweep.values[steps[i].point], *steps[i].recorded);
    const std::lock_guard lock(progress_mutex);
    on_step(++done, steps.size());
  });
  std::vector<SweepResult> results;
  for (const Sweep& sweep : sweeps) {
    results.push_back({sweep, std::vector<SweepPoint>(sweep.values.size())});
    for (std::size_t p = 0; p < sweep.values.size(); ++p) results.back().points[p].value = sweep.values[p];
  }
  for (std::size_t i = 0; i < steps.size(); ++i)
    append(parts[i], results[steps[i].sweep].points[steps[i].point]);
  return results;
}

}  // namespace geoloc::apps
