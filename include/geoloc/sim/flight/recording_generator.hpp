// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "geoloc/io/recording/recording.hpp"
#include "geoloc/sim/flight/run_settings.hpp"
#include "geoloc/sim/flight/simulated_detector.hpp"
#include "geoloc/sim/flight/terrain.hpp"

namespace geoloc::sim {

struct RecordingSettings {
  RunSettings run;
  DetectorModel detector;
  Terrain terrain;

  /// Every fault, named by its JSON path.
  std::vector<std::string> problems() const;
};

/// The frames of a run as a receiver would have recorded them: what the detector finds from the true camera
/// at the true pose, stamped on the clock of the flight's log with the exposure time plus latency and jitter.
/// Never out of order. Depends on the arguments alone.
std::vector<io::RecordedFrame> generate_frames(const Flight& flight, const RecordingSettings& settings,
                                               const std::vector<Eigen::Vector2d>& targets_in_enu);

/// What the simulator put into a run and the estimator is not told, as JSON: for evaluation.
std::string injected_json(const Flight& flight, const RecordingSettings& settings);

/// Writes the folder of docs/formats.md: the flight's telemetry as it is, the frames, the nominal camera, the
/// truth, sim.json with what was injected, and where there are hills an elevation model of them. Throws
/// std::invalid_argument naming every problem of the settings, and std::runtime_error where the folder cannot
/// be written; it appears whole or not at all.
void write_recording(const std::filesystem::path& folder, const Flight& flight,
                     const RecordingSettings& settings);

}  // namespace geoloc::sim
