// SPDX-License-Identifier: Apache-2.0
#include "sim/run_options.hpp"

#include <charconv>
#include <filesystem>
#include <system_error>

#include "geoloc/geometry/refuse.hpp"
#include "geoloc/sim/live/flight_variants.hpp"
#include "geoloc/sim/live/px4_flight.hpp"
#include "geoloc/sim/live/state_jumps.hpp"
#include "geoloc/sim/live/zoom_flight.hpp"
#include "sim/option_groups.hpp"

namespace geoloc::sim {

namespace {

/// nullopt where none is asked for. Throws std::invalid_argument for another text than "1..4" and the like.
std::optional<ZoomSettings> zoom_settings(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t dots = text.find("..");
  const auto number = [&](const std::string& part) {
    double value = 0.0;
    const char* const end = part.data() + part.size();
    const auto read = std::from_chars(part.data(), end, value);
    if (dots == std::string::npos || read.ec != std::errc{} || read.ptr != end)
      throw std::invalid_argument("--zoom " + text + ": two numbers are wanted, as in 1..4");
    return value;
  };
  const ZoomSettings settings{number(text.substr(0, dots)), number(text.substr(dots + 2))};
  refuse_if_any(settings.problems());
  return settings;
}

}  // namespace

void add_run_options(CLI::App& program, RunOptions& options) {
  RunSettings& settings = options.settings;
  CameraErrors& errors = settings.errors;
  const auto add = [&program](const char* group, const char* name, auto& value, const char* help) {
    return program.add_option(name, value, help)->group(group);
  };
  add(kFlightGroup, "--flight", options.flight, "Name of the flight; an unknown one lists them")
      ->capture_default_str();
  add(kFlightGroup, "--data-dir", options.data_folder, "Folder of the flights [found beside the program]");
  add(kFlightGroup, "--autopilot", options.autopilot,
      "Whose messages, and live whose manners: ardupilot, px4 on its link to an onboard computer, or "
      "px4-ground, "
      "to a ground station")
      ->check(CLI::IsMember({"ardupilot", "px4", "px4-ground"}))
      ->capture_default_str();
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
  CLI::Option* const attitude_noise =
      add(kHiddenGroup, "--attitude-noise-deg", options.attitude_noise.sigma_deg,
          "1-sigma of what roll, pitch and yaw are off by besides, deg")
          ->capture_default_str()
          ->check(CLI::Range(0.0, 45.0));
  add(kHiddenGroup, "--attitude-noise-s", options.attitude_noise.time_constant_s,
      "How long that lasts, s; 0: it is another in each message")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e4))
      ->needs(attitude_noise);
  add(kFlightGroup, "--start-s", settings.start_s, "Begin, s on the vehicle's clock [at survey height]");
  add(kFlightGroup, "--end-s", settings.end_s, "End, s on the vehicle's clock [survey height left]");

  add(kCameraGroup, "--frame-rate", settings.frame_rate_hz, "Frames a second")->capture_default_str();
  add(kCameraGroup, "--image-size", options.image_size_px, "Width and height of a picture, even, px")
      ->type_name("WIDTHxHEIGHT")
      ->default_str("1280x720")
      ->delimiter('x')
      ->check(CLI::Range(16, 8192));
  add(kCameraGroup, "--fov-deg", options.horizontal_fov_deg, "Horizontal field of view, deg")
      ->capture_default_str();
  CLI::Option* const mount_pitch = add(kCameraGroup, "--mount-pitch-deg", settings.camera.mount.pitch_deg,
                                       "Nominal mount; -90 looks down, deg")
                                       ->capture_default_str();
  add(kCameraGroup, "--zoom", options.zoom,
      "The camera zooms in for some seconds and out again, and tells its field of view (CAMERA_FOV_STATUS): "
      "LEAST..MOST, as in 1..4; 1 is --fov-deg [none]")
      ->type_name("LEAST..MOST");
  add(kCameraGroup, "--distortion", options.distortion, "True lens: k1 k2 p1 p2 k3 [none]");
  program
      .add_flag("--uncalibrated-lens", options.uncalibrated_lens, "Leave the distortion out of camera.json")
      ->group(kHiddenInRecordingsGroup);

  add(kHiddenGroup, "--latency-s", errors.latency_s, "Frame stamp minus exposure, s")->capture_default_str();
  add(kHiddenGroup, "--jitter-s", errors.latency_jitter_s, "1-sigma of the latency, per frame, s")
      ->capture_default_str();
  add(kHiddenGroup, "--focal-error-percent", errors.focal_percent,
      "The true focal length is so much longer than camera.json's, %")
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
  const auto [width_px, height_px] = options.image_size_px;
  if (width_px % 2 != 0 || height_px % 2 != 0)
    throw std::invalid_argument("--image-size: a video needs an even width and height");
  settings.camera.intrinsics = CameraIntrinsics::from_field_of_view(width_px, height_px, fov_deg);
  settings.camera.intrinsics.distortion = options.distortion;
  if (to_settings(options.gimbal)) settings.camera.mount = CameraMount::on_gimbal();
  settings.errors.lens_is_calibrated = !options.uncalibrated_lens;
  refuse_if_any(settings.problems());
  return settings;
}

bool is_px4(const RunOptions& options) {
  return options.autopilot != "ardupilot";
}

Flight load_flight(const RunOptions& options) {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  Flight flight = load_flight(find_flights(options.data_folder, program), options.flight);
  if (options.raised_m != 0.0) flight = raised(flight, options.raised_m);
  if (options.telemetry_rate_hz) flight = at_telemetry_rate(flight, *options.telemetry_rate_hz);
  if (options.attitude_noise.sigma_deg > 0.0) flight = with_attitude_noise(flight, options.attitude_noise);
  if (!options.jump.empty()) flight = with_jump(flight, state_jump(options.jump, flight.truth));
  if (is_px4(options)) flight = as_px4(flight);
  return flight;
}

Flight with_moving_camera(Flight flight, const RunOptions& options, const RunSettings& settings) {
  const std::uint64_t seed = run_seed(settings, flight);
  if (const auto gimbal = to_settings(options.gimbal)) flight = with_gimbal(flight, *gimbal, seed);
  if (const auto zoom = zoom_settings(options.zoom))
    flight = with_zoom(flight, *zoom, settings.camera.intrinsics, seed);
  return flight;
}

}  // namespace geoloc::sim
