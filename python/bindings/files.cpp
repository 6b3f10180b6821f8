// SPDX-License-Identifier: Apache-2.0
#include "files.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/estimation_config.hpp"
#include "geoloc/io/json/camera_fields.hpp"
#include "geoloc/io/recording/recording_writer.hpp"
#include "geoloc/io/recording/tlog.hpp"

namespace geoloc::python {

Files files_of(const io::Recording& recording) {
  Files files;
  files.camera_json = io::camera_to_json(recording.camera).dump();
  for (const io::RecordedFrame& frame : recording.frames) files.frames_jsonl += io::frame_to_line(frame);
  for (const io::TlogRecord& record : recording.telemetry.records()) {
    const auto at = std::chrono::floor<std::chrono::microseconds>(record.received_at.time_since_epoch());
    const auto stamp = io::tlog_stamp(at);
    files.telemetry.insert(files.telemetry.end(), stamp.begin(), stamp.end());
    files.telemetry.insert(files.telemetry.end(), record.frame, record.frame + record.size);
  }
  files.config_json = recording.config_json;
  if (!recording.truth.empty()) files.truth_geojson = io::truth_to_geojson(recording.truth);
  files.class_names = recording.class_names;
  files.frames_damaged = recording.frames_damaged;
  return files;
}

io::Recording recording_of(const Files& files) {
  io::Recording recording;
  std::vector<std::string> problems;
  io::camera_from_json(nlohmann::json::parse(files.camera_json), "camera", true, recording.camera, problems);
  for (const std::string& problem : recording.camera.problems()) problems.push_back(problem);
  apps::refuse_problems("camera", problems);
  std::istringstream lines(files.frames_jsonl);
  recording.frames = io::read_frames(lines, "frames", io::BadLines::kRefuse, recording.skipped);
  recording.telemetry = io::Tlog(files.telemetry);
  recording.config_json = files.config_json;
  if (files.truth_geojson) recording.truth = io::parse_truth(*files.truth_geojson, "truth");
  recording.class_names = files.class_names;
  recording.frames_damaged = files.frames_damaged;
  return recording;
}

void write(const io::Recording& recording, const std::filesystem::path& folder) {
  io::RecordingWriter writer(folder);
  writer.write_camera(recording.camera);
  if (recording.config_json) writer.write_config(*recording.config_json);
  if (!recording.class_names.empty()) writer.write_class_names(recording.class_names);
  if (!recording.truth.empty()) writer.write_truth(recording.truth);
  if (recording.frames_damaged > 0) writer.write_damaged(recording.frames_damaged);
  for (const io::TlogRecord& record : recording.telemetry.records())
    writer.add_telemetry(record.received_at, record.frame, record.size);
  for (const io::RecordedFrame& frame : recording.frames) writer.add_frame(frame);
  writer.finish();
}

}  // namespace geoloc::python
