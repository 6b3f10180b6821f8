// SPDX-License-Identifier: Apache-2.0
#include "eval/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <stdexcept>

#include "eval/parallel.hpp"
#include "geoloc/sim/flight/random_stream.hpp"
#include "geoloc/sim/flight/scenario.hpp"
#include "geoloc/sim/live/flight_variants.hpp"
#include "geoloc/sim/random.hpp"

namespace geoloc::apps {
namespace {

// As the flights of data/flights were flown.
constexpr double kFlownHeight_m = 20.0;
constexpr double kFlownSpeed_m_s = 5.0;
constexpr double kTelemetryRate_hz = 10.0;

Sweep latency() {
  Sweep sweep{
      "latency", "Latency", "frame stamp after exposure, s", false, {0.0, 0.05, 0.12, 0.2, 0.3, 0.4, 0.5},
      0.12};
  sweep.apply = [](double value, const sim::Flight&, sim::RecordingSettings& settings) {
    settings.run.errors.latency_s = value;
  };
  return sweep;
}

/// The optical axis tilted by the value, in a direction drawn for each run.
Sweep boresight() {
  Sweep sweep{"boresight",
              "Mounting error",
              "tilt of the optical axis, deg",
              false,
              {0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0}};
  sweep.usual = 0.7 * std::sqrt(0.5 * kPi);  // mean length of two components of 0.7 deg, 1 sigma
  sweep.apply = [](double value, const sim::Flight& flight, sim::RecordingSettings& settings) {
    sim::Random random(sim::stream_seed(sim::run_seed(settings.run, flight), sim::RandomStream::kMount));
    const double direction_rad = random.uniform(-kPi, kPi);
    settings.run.errors.mount_error_deg = {value * std::cos(direction_rad), value * std::sin(direction_rad),
                                           0.0};
  };
  return sweep;
}

Sweep telemetry_rate() {
  Sweep sweep{"telemetry",
              "Telemetry rate",
              "attitudes and positions a second, Hz",
              true,
              {2.0, 3.0, 5.0, 10.0, 20.0, 50.0},
              kTelemetryRate_hz};
  sweep.flight_at = [](const sim::Flight& flight, double value) {
    return sim::at_telemetry_rate(flight, value);
  };
  return sweep;
}

Sweep height() {
  Sweep sweep{"height",
              "Height",
              "height above the ground, m",
              true,
              {10.0, 15.0, 20.0, 30.0, 50.0, 80.0, 120.0},
              kFlownHeight_m,
              true};
  sweep.flight_at = [](const sim::Flight& flight, double value) {
    return sim::raised(flight, value - kFlownHeight_m);
  };
  return sweep;
}

Sweep pairs() {
  Sweep sweep{"pairs", "Targets in pairs", "distance within a pair, m", true, {0.3, 0.5, 0.8, 1.2, 2.0, 3.0},
              1.2};
  sweep.targets_at = [](double value, std::uint64_t seed) { return sim::make_pairs(value, seed); };
  sweep.apply = [](double value, const sim::Flight&, sim::RecordingSettings& settings) {
    constexpr double kShareOfDistance =
        0.7;  // boxes of two discs so large do not meet, however the pair lies
    settings.detector.target_size_m = std::min(settings.detector.target_size_m, kShareOfDistance * value);
  };
  return sweep;
}

Sweep misses() {
  Sweep sweep{"misses",
              "Missed targets",
              "share of the looks missed, %",
              false,
              {0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0},
              5.0};
  sweep.apply = [](double value, const sim::Flight&, sim::RecordingSettings& settings) {
    settings.detector.miss_rate = value / 100.0;
  };
  return sweep;
}

Sweep clutter() {
  Sweep sweep{"clutter", "Clutter", "false boxes a frame", false, {0.0, 0.5, 1.0, 1.5, 2.0, 3.0}, 0.03};
  sweep.apply = [](double value, const sim::Flight&, sim::RecordingSettings& settings) {
    settings.detector.clutter_rate = value;
  };
  return sweep;
}

Sweep speed() {
  Sweep sweep{"speed",        "Speed", "speed over ground, m/s", true, {2.0, 3.0, 5.0, 8.0, 12.0, 20.0},
              kFlownSpeed_m_s};
  sweep.flight_at = [](const sim::Flight& flight, double value) {
    return sim::at_telemetry_rate(sim::at_speed(flight, value / kFlownSpeed_m_s), kTelemetryRate_hz);
  };
  return sweep;
}

/// Targets that stand wholly in three frames at least: no method can be expected to find others.
int targets_in_view(const sim::Flight& flight, const sim::RecordingSettings& settings,
                    const std::vector<Eigen::Vector2d>& targets_in_enu) {
  constexpr int kEnough = 3;
  const sim::TrueCamera camera = sim::make_true_camera(settings.run, sim::run_seed(settings.run, flight));
  const CameraModel model(camera.intrinsics);
  const sim::TimeSpan span = sim::run_span(settings.run, flight.truth);
  const Duration period = from_seconds(1.0 / settings.run.frame_rate_hz);
  std::vector<int> frames(targets_in_enu.size(), 0);
  for (VehicleTime time = span.begin; time <= span.end; time += period) {
    const Rigid3d camera_from_enu = (flight.truth.pose(time).value() * camera.body_from_camera).inverse();
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
  const sim::Flight& flight = variant ? *variant : recorded;
  SweepPoint point{value, {}, 0};
  for (const std::uint64_t seed : experiment.seeds) {
    sim::RecordingSettings settings = experiment.recording;
    settings.run.scenario = 1;
    settings.run.seed = seed;
    if (sweep.apply) sweep.apply(value, flight, settings);
    const auto targets_in_enu =
        sweep.targets_at ? sweep.targets_at(value, seed) : sim::make_scenario(1, seed);
    const auto frames = sim::generate_frames(flight, settings, targets_in_enu);
    const auto truth = sim::true_targets(targets_in_enu, flight.truth.frame());
    for (const Contender& contender : experiment.contenders) {
      if (contender.known_points > 0) continue;
      point.runs.push_back(
          run_method({flight, settings.run, frames, truth}, contender, experiment.estimation));
    }
    if (sweep.leaves_targets_out) point.in_view += targets_in_view(flight, settings, targets_in_enu);
  }
  return point;
}

void append(const SweepPoint& from, SweepPoint& to) {
  to.runs.insert(to.runs.end(), from.runs.begin(), from.runs.end());
  to.in_view += from.in_view;
}

}  // namespace

const std::vector<Sweep>& all_sweeps() {
  static const std::vector<Sweep> sweeps{latency(), boresight(), telemetry_rate(), height(),
                                         pairs(),   misses(),    clutter(),        speed()};
  return sweeps;
}

std::vector<Sweep> find_sweeps(const std::string& name) {
  if (name == "all") return all_sweeps();
  std::string known;
  for (const Sweep& sweep : all_sweeps()) {
    if (sweep.name == name) return {sweep};
    known += " " + sweep.name;
  }
  throw std::runtime_error("--sweep " + name + ": there is none of this name; there are: all" + known);
}

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
