// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/io/log_file.hpp"
#include "geoloc/io/object_note.hpp"
#include "geoloc/io/recording/recording.hpp"

namespace geoloc::io {

/// What to do where a recording of that name exists, or is being written, or was cut off. A folder of
/// anything else is always refused.
enum class NameTaken {
  kRefuse,  ///< throw
  kNumber   ///< take the first free one of `<folder>-2`, `<folder>-3`, …
};

/// Writes a recording into `<folder>.partial`, which finish() renames to `<folder>`: a recording under its
/// own name is complete, and one that was cut off by a power failure can still be replayed. Nothing that
/// another run has written is touched. Every call throws std::runtime_error, naming the file and the system's
/// reason, when the disk does not take the data.
class RecordingWriter {
 public:
  explicit RecordingWriter(std::filesystem::path folder, NameTaken name_taken = NameTaken::kRefuse);

  /// The recording's name, which with kNumber may not be the one asked for.
  const std::filesystem::path& folder() const { return place_.folder; }

  /// The folder's name until it is complete.
  const std::filesystem::path& partial_folder() const { return place_.partial; }

  /// The small files survive a power cut at once, the folder's names too.
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
  /// What a person said of an object.
  void add_note(const NotedObject& noted);
  /// An object's best picture so far, a JPEG; replaces the one before.
  void write_picture(std::uint64_t object_id, const std::string& jpeg);
  /// The object is gone, and so is its picture, if there is one.
  void remove_picture(std::uint64_t object_id);

  /// What was added survives a power cut from now on. It may take as long as the disk does.
  void sync();

  /// Records of telemetry written so far (RecordedFrame::telemetry_records).
  std::uint64_t telemetry_records() const { return telemetry_records_; }

  /// Syncs and closes the files and gives the folder its final name. Nothing can be added afterwards.
  void finish();

 private:
  struct Place {
    std::filesystem::path folder;
    std::filesystem::path partial;
  };

  static Place make_place(std::filesystem::path folder, NameTaken name_taken);
  std::filesystem::path picture_file(std::uint64_t object_id) const;

  NameTaken name_taken_;
  Place place_;
  LogFile telemetry_;
  LogFile frames_;
  std::optional<LogFile> notes_;  // most flights have none
  std::uint64_t telemetry_records_ = 0;
};

/// A line of frames.jsonl, with its end.
std::string frame_to_line(const RecordedFrame& frame);

/// The content of truth.geojson: a FeatureCollection of Points.
std::string truth_to_geojson(const std::vector<TrueTarget>& targets);

}  // namespace geoloc::io
