// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "common/stop_signal.hpp"
#include "detect/inputs.hpp"
#include "detect/result_writer.hpp"
#include "geoloc/io/detection/detector.hpp"
#include "geoloc/io/video/video_config.hpp"

namespace geoloc::apps {

/// Looks at one file after the other. What cannot be read is told on stderr, counted, and left out.
class DetectRun {
 public:
  struct Counts {
    std::uint64_t pictures = 0;  ///< looked at, frames of videos included
    std::uint64_t with_detections = 0;
    std::uint64_t detections = 0;
    std::uint64_t unreadable = 0;  ///< files, or videos that ended before their end
    double detecting_s = 0.0;
  };

  /// All must outlive the run. `inputs`: how many there will be. `confidence`: the detector's threshold.
  DetectRun(io::Detector& detector, ResultWriter& results, const io::VideoConfig& video, std::size_t inputs,
            double confidence);

  /// Throws std::runtime_error where results cannot be written.
  void look_at(const DetectInput& input);

  bool is_stopped() const { return stop_.is_requested(); }
  const Counts& counts() const { return counts_; }

  /// For a person: what was seen, and how long a picture took.
  std::string summary() const;

  /// Takes the progress off the terminal.
  void finish();

 private:
  void look_at_video(const DetectInput& input);
  void detect(SeenPicture picture);
  void tell_unreadable(const std::string& reason);
  void show_progress(const SeenPicture& picture);

  io::Detector& detector_;
  ResultWriter& results_;
  io::VideoConfig video_;
  std::size_t inputs_;
  double confidence_;
  StopSignal stop_;
  Counts counts_;
  std::uint64_t files_ = 0;
  bool is_terminal_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point shown_{};
};

}  // namespace geoloc::apps
