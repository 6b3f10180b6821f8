// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eval/experiment.hpp"
#include "geoloc/io/detection/yolo_detector.hpp"

namespace geoloc::apps {

struct RenderedSettings {
  std::string flight = "stock_path1";
  std::uint64_t seed = 0;
  int distractors = 20;              ///< things on the ground that look like targets
  std::optional<double> length_s;    ///< [s] of the survey, from its beginning; unset: all of it
  std::filesystem::path recordings;  ///< a recording of each scenario goes here, to be replayed; empty: none
  io::DetectorFiles model;
  io::DetectionConfig detection;  ///< all but its threads
};

/// One method on one flight, once with what the detector found in drawn pictures, and once with detections
/// drawn from the noise model. Exposures, latency, mounting and targets are the same in both.
struct RenderedRun {
  RunResult from_pictures;
  RunResult from_model;
  std::size_t frames = 0;
};

/// How much worse the pictures are; nullopt where either run found nothing.
std::optional<double> rmse_ratio(const RenderedRun& run);

/// Each scenario of the experiment with each method, in this order. Pictures are drawn and looked at as fast
/// as the threads allow; their number changes nothing. Throws std::runtime_error for a flight or a model that
/// cannot be loaded.
std::vector<RenderedRun> run_rendered(
    const Experiment& experiment, const RenderedSettings& settings, unsigned threads,
    const std::function<void(std::size_t done, std::size_t total)>& on_frame);

}  // namespace geoloc::apps
