// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/io/recording/recording.hpp"

namespace geoloc::io {

/// Writes a recording into `<folder>.partial`, which finish() renames to `<folder>`: a recording under its
/// own name is complete, and one that was cut off by a power failure can still be replayed. Every call throws
/// std::runtime_error, naming the file and the system's reason, when the disk does not take the data.
class RecordingWriter {
 public:
  /// Throws also when `folder` exists already and is not empty.
  explicit RecordingWriter(std::filesystem::path folder);

  void write_camera(const CameraConfig& camera);
  void write_config(const std::string& json);
  void write_class_names(const std::vector<std::string>& names);
  void write_truth(const std::vector<TrueTarget>& targets);
  /// Frames that were left out because they were damaged; at the end of the run.
  void write_damaged(std::uint64_t frames);
  /// Any further small file, e.g. what a simulator injected.
  void write_extra(const std::string& name, const std::string& content);

  /// `frame`: one whole MAVLink frame as received.
  void add_telemetry(HostTime received_at, const std::uint8_t* frame, std::size_t size);
  void add_frame(const RecordedFrame& frame);

  /// Records of telemetry written so far (RecordedFrame::telemetry_records).
  std::uint64_t telemetry_records() const { return telemetry_records_; }

  /// Closes the files and gives the folder its final name. Nothing can be added afterwards.
  void finish();

 private:
  std::filesystem::path folder_;
  std::filesystem::path partial_;
  std::ofstream telemetry_;
  std::ofstream frames_;
  std::uint64_t telemetry_records_ = 0;
};

/// The content of truth.geojson: a FeatureCollection of Points.
std::string truth_to_geojson(const std::vector<TrueTarget>& targets);

}  // namespace geoloc::io
