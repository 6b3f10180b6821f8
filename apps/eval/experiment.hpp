// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/estimation_config.hpp"
#include "eval/run_progress.hpp"
#include "geoloc/evaluation/score.hpp"
#include "geoloc/sim/flight/recording_generator.hpp"

namespace geoloc::apps {

/// An estimator, and how many targets of each run it is told; those are not scored.
struct Contender {
  Method method = Method::kPaper;
  int known_points = 0;  ///< the paper's method has no use for any

  bool operator==(const Contender& other) const {
    return method == other.method && known_points == other.known_points;
  }
};

/// The paper's protocol: every flight over every scenario, for several seeds.
struct Experiment {
  std::filesystem::path flights_folder;
  std::vector<std::string> flights;
  std::vector<int> scenarios{1, 2, 3};
  std::vector<std::uint64_t> seeds{0, 1, 2};
  std::vector<Contender> contenders{{Method::kPaper, 0}, {Method::kJoint, 0}};
  sim::RecordingSettings recording;     ///< flight, scenario and seed are set for each run
  EstimationConfig estimation;          ///< camera and method are set for each run
  bool has_rangefinder = false;         ///< the vehicles measure the distance to the ground below them
  std::optional<double> dem_spacing_m;  ///< the estimator is told an elevation model with such nodes
};

/// The flight with what the experiment's vehicles tell besides; nullopt: nothing.
std::optional<sim::Flight> better_equipped(const sim::Flight& recorded,
                                           const sim::RecordingSettings& settings,
                                           const Experiment& experiment);

/// What a run's estimator is told besides camera and method.
EstimationConfig estimation_over(const sim::Terrain& terrain, const LocalFrame& frame,
                                 const Experiment& experiment);

/// Estimated minus injected, with the stated sigma; only where the method estimates it.
struct CalibrationError {
  double latency_s = 0.0;
  double sigma_latency_s = 0.0;
  Eigen::Vector2d boresight_deg = Eigen::Vector2d::Zero();  ///< about the camera's x and y
  Eigen::Vector2d sigma_boresight_deg = Eigen::Vector2d::Zero();
  /// What is left of the focal length's error, where that is an unknown [%].
  std::optional<double> focal_percent;
  double sigma_focal_percent = 0.0;
  double injected_latency_s = 0.0;
  Eigen::Vector2d injected_boresight_deg = Eigen::Vector2d::Zero();
};

struct RunResult {
  std::string flight;
  int scenario = 0;
  std::uint64_t seed = 0;
  Contender contender;
  Score score;
  std::optional<HeightScore> heights;  ///< where the method estimates them
  double nees = 0.0;                   ///< mean over the objects found; 2 is right
  int known_points_used = 0;
  int known_points_mistaken = 0;  ///< used, and taken for another target
  std::optional<CalibrationError> calibration;
  std::vector<ProgressSample> progress;  ///< where it was asked for
};

/// What an estimator is given, and what only its judge knows.
struct SimulatedRun {
  const sim::Flight& flight;
  const sim::RunSettings& settings;
  const std::vector<io::RecordedFrame>& frames;
  const std::vector<io::TrueTarget>& truth;
  bool wants_progress = false;
};

/// One estimator on one run. Camera, method and known points of `config` are set here.
RunResult run_method(const SimulatedRun& run, const Contender& contender, EstimationConfig config);

/// All runs, in the order flight, scenario, seed, method, whatever the number of threads. `on_run` is called
/// after each, from any thread, one at a time. Throws std::runtime_error for a flight that cannot be loaded.
std::vector<RunResult> run_experiment(const Experiment& experiment, unsigned threads,
                                      const std::function<void(std::size_t done, std::size_t total)>& on_run);

}  // namespace geoloc::apps
