// SPDX-License-Identifier: Apache-2.0
#include "sim/run_options.hpp"

#include <filesystem>

#include "geoloc/geometry/problems.hpp"
#include "geoloc/sim/live/flight_variants.hpp"
#include "geoloc/sim/live/state_jumps.hpp"
#include "sim/option_groups.hpp"

namespace geoloc::sim {

void add_run_options(CLI::App& program, RunOptions& options) {
  RunSettings& settings = options.settings;
  CameraErrors& errors = settings.errors;
  const auto add = [&program](const char* group, const char* name, auto& value, const char* help) {
    return program.add_option(name, value, help)->group(group);
  };
  add(kFlightGroup, "--flight", options.flight, "Name of the flight; an unknown one lists them")
      ->capture_default_str();
  add(kFlightGroup, "--data-dir", options.data_folder, "Folder of the flights [found beside the program]");
  CLI::Option* const scenario =
      add(kFlightGroup, "--scenario", settings.scenario, "Targets: 1 spread, 2 tight clusters, 3 grid")
          ->capture_default_str();
  add(kFlightGroup, "--pairs-m", settings.pair_distance_m, "Targets in pairs so far apart instead, m")
      ->excludes(scenario);
  add(kFlightGroup, "--raise-m", options.raised_m, "Fly so much higher than was flown (20 m), m")
      ->capture_default_str()
      ->check(CLI::Range(-15.0, 400.0));
  add(kFlightGroup, "--jump", options.jump,
      "In the middle of the survey, what the autopilot believes jumps: glitch (50 m for 5 s), reset (3 m), "
      "height (10 m), yaw (20 deg), home (set 3 m lower) [none]")
      ->type_name("NAME");
  add(kFlightGroup, "--telemetry-rate", options.telemetry_rate_hz,
      "Attitudes and positions a second [as flown]")
      ->check(CLI::Range(0.1, 100.0));
  add(kFlightGroup, "--start-s", settings.start_s, "Begin, s on the vehicle's clock [at survey height]");
  add(kFlightGroup, "--end-s", settings.end_s, "End, s on the vehicle's clock [survey height left]");

  add(kCameraGroup, "--frame-rate", settings.frame_rate_hz, "Frames a second")->capture_default_str();
  add(kCameraGroup, "--fov-deg", options.horizontal_fov_deg, "Horizontal field of view, deg")
      ->capture_default_str();
  CLI::Option* const mount_pitch = add(kCameraGroup, "--mount-pitch-deg", settings.camera.mount.pitch_deg,
                                       "Nominal mount; -90 looks down, deg")
                                       ->capture_default_str();
  add(kCameraGroup, "--distortion", options.distortion, "True lens: k1 k2 p1 p2 k3 [none]");
  program
      .add_flag("--uncalibrated-lens", options.uncalibrated_lens, "Leave the distortion out of camera.json")
      ->group(kHiddenInRecordingsGroup);

  add(kHiddenGroup, "--latency-s", errors.latency_s, "Frame stamp minus exposure, s")->capture_default_str();
  add(kHiddenGroup, "--jitter-s", errors.latency_jitter_s, "1-sigma of the latency, per frame, s")
      ->capture_default_str();
  add(kHiddenInRecordingsGroup, "--clock-step-s", errors.clock_step_s,
      "The camera's clock is ahead by so much from the middle on, s")
      ->capture_default_str();
  add(kHiddenInRecordingsGroup, "--late-start-s", errors.late_start_s,
      "Stamps of the first seconds are later by so much, s")
      ->capture_default_str();
  add_gimbal_options(program, options.gimbal, mount_pitch);
  program
      .add_flag("--sei", options.has_sei,
                "The video's frames carry the telemetry (SEI, apcg.telemetry.v1); of a recording, those of "
                "--video")
      ->group(kCameraGroup);
  CLI::Option* const sigma = add(kHiddenGroup, "--mount-sigma-deg", errors.mount_sigma_deg,
                                 "1-sigma of the mounting error, per axis, deg")
                                 ->capture_default_str();
  add(kHiddenGroup, "--mount-error-deg", errors.mount_error_deg,
      "Mounting error about forward, right, down, deg")
      ->excludes(sigma);
}

RunSettings to_settings(const RunOptions& options, std::uint64_t seed) {
  RunSettings settings = options.settings;
  settings.seed = seed;
  const double fov_deg = options.horizontal_fov_deg;
  if (!(fov_deg > 0.0 && fov_deg < 170.0)) throw std::invalid_argument("--fov-deg must lie in (0, 170)");
  settings.camera.intrinsics = CameraIntrinsics::from_field_of_view(1280, 720, fov_deg);
  settings.camera.intrinsics.distortion = options.distortion;
  if (to_settings(options.gimbal)) settings.camera.mount = CameraMount::on_gimbal();
  settings.errors.lens_is_calibrated = !options.uncalibrated_lens;
  throw_if_any(settings.problems());
  return settings;
}

Flight load_flight(const RunOptions& options) {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  Flight flight = load_flight(find_flights(options.data_folder, program), options.flight);
  if (options.raised_m != 0.0) flight = raised(flight, options.raised_m);
  if (options.telemetry_rate_hz) flight = at_telemetry_rate(flight, *options.telemetry_rate_hz);
  if (!options.jump.empty()) flight = with_jump(flight, state_jump(options.jump, flight.truth));
  return flight;
}

Flight with_gimbal(Flight flight, const RunOptions& options, const RunSettings& settings) {
  const auto gimbal = to_settings(options.gimbal);
  if (!gimbal) return flight;
  return with_gimbal(flight, *gimbal, run_seed(settings, flight));
}

}  // namespace geoloc::sim
