// SPDX-License-Identifier: Apache-2.0
#include "eval/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "geoloc/sim/flight/random_stream.hpp"
#include "geoloc/sim/flight/scenario.hpp"
#include "geoloc/sim/live/flight_variants.hpp"
#include "geoloc/sim/live/state_jumps.hpp"
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

/// The estimator is told the equivalent for film of 35 mm.
Sweep focal_length() {
  constexpr double kSigma_percent = 3.0;
  Sweep sweep{"focal",
              "Focal length",
              "true focal length longer than told, %",
              false,
              {-6.0, -3.0, -1.0, 0.0, 1.0, 3.0, 6.0}};
  sweep.apply = [](double value, const sim::Flight&, sim::RecordingSettings& settings) {
    settings.run.errors.focal_percent = value;
  };
  sweep.configure = [](double, EstimationConfig& config) {
    config.geolocator.joint.prior.sigma_focal_percent = kSigma_percent;
  };
  return sweep;
}

Sweep telemetry_rate() {
  Sweep sweep{"telemetry",
              "Telemetry rate",
              "rate of attitudes and positions, Hz",
              true,
              {1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0},
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

Sweep hills() {
  Sweep sweep{
      "hills", "Hills", "amplitude of the ground's waves, m", false, {0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0}};
  sweep.apply = [](double value, const sim::Flight&, sim::RecordingSettings& settings) {
    settings.terrain.hills_m = value;
  };
  return sweep;
}

/// The same flights over the same ground, taken off elsewhere.
Sweep take_off() {
  Sweep sweep{"take-off",
              "Take-off elsewhere",
              "ground above the place of take-off, m",
              false,
              {-20.0, -10.0, -5.0, 0.0, 5.0, 10.0, 20.0}};
  sweep.flight_at = [](const sim::Flight& flight, double value) { return sim::raised(flight, value); };
  sweep.apply = [](double value, const sim::Flight&, sim::RecordingSettings& settings) {
    settings.terrain.level_above_home_m = value;
  };
  return sweep;
}

/// White, or such as a filter leaves that its accelerometers correct within seconds.
Sweep attitude_noise(const std::string& name, const std::string& title, double time_constant_s) {
  Sweep sweep{name, title, "1-sigma of each angle, deg", false, {0.0, 0.3, 0.5, 1.0, 1.5}};
  sweep.flight_at = [time_constant_s](const sim::Flight& flight, double value) {
    return sim::with_attitude_noise(flight, {value, time_constant_s});
  };
  return sweep;
}

/// One value a jump; 0: none.
Sweep jumps(const std::string& name, const std::string& title, double telemetry_hz) {
  const std::vector<std::string> names = sim::state_jump_names();
  Sweep sweep{name, title, "0: none", false, {0.0}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    sweep.values.push_back(static_cast<double>(i + 1));
    sweep.axis += ", " + std::to_string(i + 1) + ": " + names[i];
  }
  sweep.flight_at = [names, telemetry_hz](const sim::Flight& flight, double value) {
    const auto number = static_cast<std::size_t>(value);
    const bool is_none = number == 0;
    return sim::with_jump(sim::at_telemetry_rate(flight, telemetry_hz),
                          is_none ? sim::StateJump{} : sim::state_jump(names.at(number - 1), flight.truth));
  };
  return sweep;
}

/// A survey of eighteen pictures from 60 m at 12.5 m/s, stamped exactly.
Sweep turned_yaws() {
  Sweep sweep{"turned-yaws", "Yaws turned round", "of eighteen pictures", false, {0.0, 1.0, 3.0, 6.0}};
  sweep.leaves_targets_out = true;
  const auto stills = [](double value) {
    sim::Stills pictures;
    pictures.turned = static_cast<int>(value);
    return pictures;
  };
  sweep.flight_at = [stills](const sim::Flight& flight, double value) {
    constexpr double kHeight_m = 60.0, kSpeed_m_s = 12.5;
    const sim::Flight raised = sim::raised(flight, kHeight_m - kFlownHeight_m);
    return sim::as_stills(sim::at_speed(raised, kSpeed_m_s / kFlownSpeed_m_s), stills(value));
  };
  sweep.apply = [stills](double value, const sim::Flight& flight, sim::RecordingSettings& settings) {
    settings.run.frame_rate_hz = 1.0 / seconds(sim::period_of(stills(value), flight));
    settings.run.errors.latency_s = settings.run.errors.latency_jitter_s = 0.0;
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
  Sweep sweep{"clutter", "Clutter", "false boxes per frame", false, {0.0, 0.5, 1.0, 1.5, 2.0, 3.0}, 0.03};
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

Sweep camera_clock() {
  Sweep sweep{"clock-camera",
              "Camera's clock",
              "ahead from the start, s",
              false,
              {-2.9, -1.0, -0.3, 0.0, 0.3, 1.0, 2.9}};
  sweep.apply = [](double value, const sim::Flight&, sim::RecordingSettings& settings) {
    settings.run.errors.latency_s += value;
  };
  return sweep;
}

Sweep camera_clock_step() {
  Sweep sweep{"clock-step",
              "Camera's clock steps",
              "ahead from mid-flight on, s",
              false,
              {-2.9, -1.0, -0.3, 0.0, 0.3, 1.0, 2.9}};
  sweep.apply = [](double value, const sim::Flight&, sim::RecordingSettings& settings) {
    settings.run.errors.clock_step_s = value;
  };
  return sweep;
}

Sweep vehicle_clock_stop() {
  Sweep sweep{
      "clock-stop", "Vehicle's clock stops", "pause in mid-flight, s", false, {0.0, 0.3, 0.4, 1.0, 2.9}};
  sweep.flight_at = [](const sim::Flight& flight, double value) {
    return sim::with_stopped_clock(flight, value);
  };
  return sweep;
}

Sweep late_start() {
  Sweep sweep{"clock-late",
              "Stream stamped by arrival at first",
              "first stamps later, s",
              false,
              {0.0, 0.1, 0.2, 0.3, 0.5}};
  sweep.apply = [](double value, const sim::Flight&, sim::RecordingSettings& settings) {
    settings.run.errors.late_start_s = value;
  };
  return sweep;
}

}  // namespace

const std::vector<Sweep>& all_sweeps() {
  static const std::vector<Sweep> sweeps{latency(),
                                         boresight(),
                                         focal_length(),
                                         telemetry_rate(),
                                         height(),
                                         hills(),
                                         take_off(),
                                         attitude_noise("attitude", "Attitude noise, white", 0.0),
                                         attitude_noise("attitude-slow", "Attitude noise over 4 s", 4.0),
                                         jumps("jumps", "Jumps of the vehicle's state", kTelemetryRate_hz),
                                         jumps("jumps-slow", "The same jumps, telemetry at 2 Hz", 2.0),
                                         turned_yaws(),
                                         pairs(),
                                         misses(),
                                         clutter(),
                                         speed(),
                                         camera_clock(),
                                         camera_clock_step(),
                                         vehicle_clock_stop(),
                                         late_start()};
  return sweeps;
}

std::vector<Sweep> find_sweeps(const std::string& name) {
  if (name == "all") return all_sweeps();
  std::vector<Sweep> found;
  std::string known;
  for (const Sweep& sweep : all_sweeps()) {
    const bool is_clock = sweep.name.rfind("clock-", 0) == 0;
    if (sweep.name == name || (name == "clocks" && is_clock)) found.push_back(sweep);
    known += " " + sweep.name;
  }
  if (!found.empty()) return found;
  throw std::runtime_error("--sweep " + name + ": there is none of this name; there are: all clocks" + known);
}

}  // namespace geoloc::apps
