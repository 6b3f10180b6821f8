// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/flight/recording_generator.hpp"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "geoloc/geometry/problems.hpp"
#include "geoloc/geometry/refuse.hpp"
#include "geoloc/io/recording/recording_writer.hpp"
#include "geoloc/sim/flight/random_stream.hpp"
#include "geoloc/sim/random.hpp"

namespace geoloc::sim {
namespace {

/// Earlier by more than a jitter: the clock was set back, and a receiver takes none until it has caught up.
constexpr Duration kMostDisorder = std::chrono::milliseconds{50};

/// What the camera's clock adds to the stamps of a moment.
double clock_error_s(const CameraErrors& errors, const TimeSpan& span, VehicleTime exposed_at) {
  const bool is_start = seconds(exposed_at - span.begin) < kStreamStart_s;
  const bool is_after_step = exposed_at - span.begin > span.end - exposed_at;
  return (is_start ? errors.late_start_s : 0.0) + (is_after_step ? errors.clock_step_s : 0.0);
}

}  // namespace

std::vector<std::string> RecordingSettings::problems() const {
  Problems found;
  found.add(run.problems());
  found.add(detector.problems());
  found.add(terrain.problems());
  return found.take();
}

std::vector<io::RecordedFrame> generate_frames(const Flight& flight, const RecordingSettings& settings,
                                               const std::vector<Eigen::Vector2d>& targets_in_enu) {
  const CameraErrors& errors = settings.run.errors;
  const std::uint64_t seed = run_seed(settings.run, flight);
  const TrueCamera camera = make_true_camera(settings.run, seed);
  SimulatedDetector detector(settings.detector, camera.intrinsics,
                             standing_on(settings.terrain, targets_in_enu), seed);
  Random timing(stream_seed(seed, RandomStream::kTiming));
  const TimeSpan span = run_span(settings.run, flight.truth);

  std::vector<io::RecordedFrame> frames;
  for (std::int64_t number = 0;; ++number) {
    const VehicleTime exposed_at =
        span.begin + from_seconds(static_cast<double>(number) / settings.run.frame_rate_hz);
    const auto enu_from_camera =
        exposed_at > span.end ? std::nullopt : flight.enu_from_camera(exposed_at, camera.carrier_from_camera);
    if (!enu_from_camera) break;
    const Duration delay = from_seconds(errors.latency_s + clock_error_s(errors, span, exposed_at) +
                                        errors.latency_jitter_s * timing.normal());
    HostTime stamp{std::chrono::round<std::chrono::microseconds>(
        (flight.host_time(exposed_at) + delay).time_since_epoch())};
    if (!frames.empty() && stamp < frames.back().captured_at - kMostDisorder) continue;
    if (!frames.empty()) stamp = std::max(stamp, frames.back().captured_at);
    frames.push_back({stamp, detector.detect(*enu_from_camera, flight.zoom_at(exposed_at)), std::nullopt});
  }
  return frames;
}

std::string injected_json(const Flight& flight, const RecordingSettings& settings) {
  const RunSettings& run = settings.run;
  const TimeSpan span = run_span(run, flight.truth);
  const TrueCamera camera = make_true_camera(run, run_seed(run, flight));
  const Eigen::Vector3d& error_deg = camera.mount_error_deg;
  const nlohmann::ordered_json document{
      {"flight", flight.name},
      {"scenario", run.scenario},
      {"seed", run.seed},
      {"start_s", seconds(span.begin.time_since_epoch())},
      {"end_s", seconds(span.end.time_since_epoch())},
      {"frame_rate_hz", run.frame_rate_hz},
      {"latency_s", run.errors.latency_s},
      {"latency_jitter_s", run.errors.latency_jitter_s},
      {"clock_step_s", run.errors.clock_step_s},
      {"late_start_s", run.errors.late_start_s},
      {"mount_error_deg", {{"roll", error_deg.x()}, {"pitch", error_deg.y()}, {"yaw", error_deg.z()}}},
      {"focal_percent", run.errors.focal_percent},
      {"distortion", camera.intrinsics.distortion},
      {"lens_is_calibrated", run.errors.lens_is_calibrated},
      {"terrain",
       {{"hills_m", settings.terrain.hills_m}, {"level_above_home_m", settings.terrain.level_above_home_m}}},
      {"detector",
       {{"target_size_m", settings.detector.target_size_m},
        {"pixel_noise_px", settings.detector.pixel_noise_px},
        {"miss_rate", settings.detector.miss_rate},
        {"clutter_rate", settings.detector.clutter_rate},
        {"confidence", settings.detector.confidence},
        {"clutter_confidence", settings.detector.clutter_confidence},
        {"min_visible_fraction", settings.detector.min_visible_fraction}}}};
  return document.dump(2) + "\n";
}

void write_recording(const std::filesystem::path& folder, const Flight& flight,
                     const RecordingSettings& settings) {
  refuse_if_any(settings.problems());
  const std::vector<Eigen::Vector2d> targets_in_enu = make_targets(settings.run);
  const std::vector<io::RecordedFrame> frames = generate_frames(flight, settings, targets_in_enu);

  io::RecordingWriter writer(folder);
  writer.write_camera(nominal_camera(settings.run));
  writer.write_truth(true_targets(standing_on(settings.terrain, targets_in_enu), flight.truth.frame()));
  writer.write_extra("sim.json", injected_json(flight, settings));
  if (settings.terrain.hills_m > 0.0) {
    constexpr double kSpacing_m = 2.0;
    writer.write_extra("terrain.asc", to_ascii_grid(elevation_model(settings.terrain, flight.truth.frame(),
                                                                    kSpacing_m, Site{}.ground_height_msl_m)));
    writer.write_extra("terrain.prj", wgs84_prj());
  }
  for (const io::TlogRecord& record : flight.telemetry.records()) {
    writer.add_telemetry(record.received_at, record.frame, record.size);
  }
  for (const io::RecordedFrame& frame : frames) writer.add_frame(frame);
  writer.finish();
}

}  // namespace geoloc::sim
