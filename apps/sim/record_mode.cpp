// SPDX-License-Identifier: Apache-2.0
#include "sim/record_mode.hpp"

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "geoloc/geometry/refuse.hpp"
#include "geoloc/sim/flight/recording_generator.hpp"
#include "geoloc/sim/live/flight_variants.hpp"
#include "geoloc/sim/live/rangefinder.hpp"
#include "sim/flight_video.hpp"
#include "sim/option_groups.hpp"

namespace geoloc::sim {

CLI::Option* add_record_options(CLI::App& program, RecordOptions& options) {
  DetectorModel& detector = options.detector;
  const auto add = [&program](const char* name, auto& value, const char* help) {
    return program.add_option(name, value, help)->group(kRecordGroup);
  };
  CLI::Option* const record = add("--record", options.folder, "Write a recording into this new folder");
  add("--pixel-noise", detector.pixel_noise_px, "1-sigma of a box's centre, px")->capture_default_str();
  add("--miss-rate", detector.miss_rate, "Share of the visible targets not found")->capture_default_str();
  add("--clutter-rate", detector.clutter_rate, "Mean number of false boxes in a frame")
      ->capture_default_str();
  add("--confidence", detector.confidence, "Of targets that are found, the least and the most")
      ->delimiter(',')
      ->capture_default_str();
  add("--clutter-confidence", detector.clutter_confidence, "Of false boxes")
      ->delimiter(',')
      ->capture_default_str();
  add("--target-size-m", detector.target_size_m, "Diameter of a target, m")->capture_default_str();
  add("--min-visible-fraction", detector.min_visible_fraction, "Of a box that is found, in the image")
      ->capture_default_str();
  add("--hills-m", options.terrain.hills_m, "Amplitude of the ground's waves, m")->capture_default_str();
  add("--ground-above-home-m", options.terrain.level_above_home_m,
      "Height of the ground above the place of take-off, m; the flight is as high above the ground as "
      "without")
      ->capture_default_str();
  program
      .add_flag(
          "--video", options.has_video,
          "Also draw what the camera saw, on level ground: video.mkv in the recording; its frames are those "
          "of frames.jsonl, whose detections stay the noise model's")
      ->group(kRecordGroup)
      ->excludes(program.get_option("--hills-m"), program.get_option("--ground-above-home-m"));
  program
      .add_flag("--rangefinder", options.has_rangefinder,
                "The vehicle measures the distance to the ground below it (DISTANCE_SENSOR)")
      ->group(kRecordGroup);
  return record;
}

int run_record_mode(const RunOptions& run, const RecordOptions& options, std::uint64_t seed) {
  const auto fail = [](const std::exception& error, int status) {
    std::fprintf(stderr, "geoloc_sim: %s\n", error.what());
    return status;
  };
  RecordingSettings settings;
  std::optional<Flight> flight;
  try {
    settings = {to_settings(run, seed), options.detector, options.terrain};
    refuse_if_any(settings.problems());
    if (run.has_sei && !options.has_video)
      throw std::invalid_argument("--sei: a recording without --video has no frames to carry the telemetry");
    if (std::filesystem::exists(options.folder)) {
      throw std::invalid_argument("--record " + options.folder + ": exists already; name a new folder");
    }
    flight = load_flight(run);
    if (options.terrain.level_above_home_m != 0.0)
      flight = raised(*flight, options.terrain.level_above_home_m);
    run_span(settings.run, flight->truth);  // refuses times outside the flight
    if (options.has_rangefinder)
      flight = with_rangefinder(*flight, options.terrain, run_seed(settings.run, *flight));
    flight = with_moving_camera(std::move(*flight), run, settings.run);
  } catch (const std::exception& error) {
    return fail(error, 2);
  }
  try {
    write_recording(options.folder, *flight, settings);
    if (options.has_video)
      write_flight_video(std::filesystem::path(options.folder) / "video.mkv", *flight, settings.run,
                         generate_frames(*flight, settings, make_targets(settings.run)), run.has_sei);
  } catch (const std::exception& error) {
    return fail(error, 1);
  }
  std::fprintf(stderr, "%s: flight %s, scenario %d, seed %llu\n", options.folder.c_str(),
               flight->name.c_str(), settings.run.scenario, static_cast<unsigned long long>(seed));
  return 0;
}

}  // namespace geoloc::sim
