// SPDX-License-Identifier: Apache-2.0
#include "eval/rendered_run.hpp"

#include <algorithm>
#include <mutex>
#include <opencv2/core.hpp>

#include "eval/parallel.hpp"
#include "geoloc/io/recording/recording_writer.hpp"
#include "geoloc/sim/flight/scenario.hpp"
#include "geoloc/sim/live/flight_camera.hpp"

namespace geoloc::apps {
namespace {

/// The survey is drawn in so many parts, so that the threads have enough to do at every time. It is fixed
/// because the sensor's noise begins anew with each part: results must not depend on the number of threads.
constexpr std::size_t kParts = 4;

/// One scenario: what both runs share, and what the detector found.
struct RenderedScenario {
  sim::RecordingSettings settings;
  std::vector<Eigen::Vector2d> targets_in_enu;
  std::vector<io::RecordedFrame> from_model;
  std::vector<io::RecordedFrame> from_pictures;  // stamped alike
};

RenderedScenario make_rendered_scenario(const Experiment& experiment, const RenderedSettings& settings,
                                        const sim::Flight& flight, int scenario) {
  RenderedScenario made;
  made.settings = experiment.recording;
  made.settings.run.scenario = scenario;
  made.settings.run.seed = settings.seed;
  if (settings.length_s) {
    const double begin_s = seconds(flight.truth.survey().begin.time_since_epoch());
    made.settings.run.end_s = begin_s + *settings.length_s;
  }
  made.targets_in_enu = sim::make_scenario(scenario, settings.seed);
  made.from_model = sim::generate_frames(flight, made.settings, made.targets_in_enu);
  made.from_pictures = made.from_model;
  for (io::RecordedFrame& frame : made.from_pictures) frame.detections.clear();
  return made;
}

/// Draws the frames of one part of a scenario, and looks at them.
void detect_part(const sim::Flight& flight, const RenderedSettings& settings, std::size_t part,
                 RenderedScenario& scenario, const std::function<void()>& on_frame) {
  // In the time of the recording: the flight is neither sped up nor waited for.
  sim::FlightClock clock(flight.truth.span(), 1.0);
  clock.release(flight.host_time(flight.truth.span().begin));
  sim::FlightCamera camera(
      flight, scenario.settings.run, clock,
      sim::make_run_scene(scenario.targets_in_enu, settings.distractors, scenario.settings.run.seed));
  io::DetectionConfig config = settings.detection;
  config.threads = 1;  // the parts run side by side
  const auto detector = io::open_detector(settings.model, config);

  std::vector<io::RecordedFrame>& frames = scenario.from_pictures;
  const std::size_t begin = frames.size() * part / kParts, end = frames.size() * (part + 1) / kParts;
  cv::Mat picture;
  for (std::size_t i = 0; i < end; ++i) {
    // Drawn for all frames from the first: the latencies are those that generate_frames() drew.
    const sim::FlightCamera::View view = camera.draw_view(frames[i].captured_at);
    if (i < begin) continue;
    camera.render(view, picture);
    frames[i].detections = detector->detect(picture);
    on_frame();
  }
}

/// What the detector found, for geoloc_replay: the folder of docs/formats.md, in the place of an older one.
void record(const std::filesystem::path& folder, const sim::Flight& flight,
            const RenderedScenario& scenario) {
  std::filesystem::remove_all(folder);
  std::filesystem::remove_all(folder.string() + ".partial");
  io::RecordingWriter writer(folder);
  writer.write_camera(sim::nominal_camera(scenario.settings.run));
  writer.write_truth(sim::true_targets(sim::standing_on({}, scenario.targets_in_enu), flight.truth.frame()));
  writer.write_extra("sim.json", sim::injected_json(flight, scenario.settings));
  for (const io::TlogRecord& record : flight.telemetry.records())
    writer.add_telemetry(record.received_at, record.frame, record.size);
  for (const io::RecordedFrame& frame : scenario.from_pictures) writer.add_frame(frame);
  writer.finish();
}

}  // namespace

std::optional<double> rmse_ratio(const RenderedRun& run) {
  const Score &pictures = run.from_pictures.score, &model = run.from_model.score;
  if (!pictures.rmse_m || !model.rmse_m) return std::nullopt;
  return *pictures.rmse_m / *model.rmse_m;
}

std::vector<RenderedRun> run_rendered(
    const Experiment& experiment, const RenderedSettings& settings, unsigned threads,
    const std::function<void(std::size_t done, std::size_t total)>& on_frame) {
  const sim::Flight flight = sim::load_flight(experiment.flights_folder, settings.flight);
  std::vector<RenderedScenario> scenarios;
  std::size_t total = 0, done = 0;
  for (const int number : experiment.scenarios) {
    scenarios.push_back(make_rendered_scenario(experiment, settings, flight, number));
    total += scenarios.back().from_pictures.size();
  }
  std::mutex progress_mutex;
  parallel_for(scenarios.size() * kParts, threads, [&](std::size_t i) {
    detect_part(flight, settings, i % kParts, scenarios[i / kParts], [&] {
      const std::lock_guard lock(progress_mutex);
      on_frame(++done, total);
    });
  });

  std::vector<RenderedRun> runs;
  for (const RenderedScenario& scenario : scenarios) {
    if (!settings.recordings.empty()) {
      const std::string name = settings.flight + "_scenario" + std::to_string(scenario.settings.run.scenario);
      record(settings.recordings / name, flight, scenario);
    }
    const auto truth = sim::true_targets(sim::standing_on({}, scenario.targets_in_enu), flight.truth.frame());
    for (const Contender& contender : experiment.contenders) {
      if (contender.known_points > 0) continue;
      const auto run = [&](const std::vector<io::RecordedFrame>& frames) {
        return run_method({flight, scenario.settings.run, frames, truth}, contender, experiment.estimation);
      };
      runs.push_back({run(scenario.from_pictures), run(scenario.from_model), scenario.from_pictures.size()});
    }
  }
  return runs;
}

}  // namespace geoloc::apps
