// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "geoloc/io/recording/recording.hpp"
#include "geoloc/io/recording/recording_writer.hpp"
#include "import/flight_plan.hpp"
#include "import/picture_looks.hpp"

namespace geoloc::apps {

/// A recording that is being made. What is not finished leaves nothing behind.
class RecordingMaker {
 public:
  /// Throws std::runtime_error where something of that name exists.
  explicit RecordingMaker(std::filesystem::path folder) : writer_(std::move(folder)) {}
  ~RecordingMaker();
  RecordingMaker(const RecordingMaker&) = delete;
  RecordingMaker& operator=(const RecordingMaker&) = delete;

  /// The vehicle's state at every exposure, and a frame of each that was looked at.
  void write(const FlightPlan& plan, const PictureLooks& looks);

  /// Writes what else belongs into the recording.
  io::RecordingWriter& writer() { return writer_; }

  /// Gives the recording its name.
  void finish();

 private:
  void write_state(const Exposure& exposure);

  io::RecordingWriter writer_;
  io::StateWriter state_;
  bool is_finished_ = false;
};

}  // namespace geoloc::apps
