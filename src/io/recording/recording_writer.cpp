// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/recording/recording_writer.hpp"

#include <array>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "geoloc/io/json/camera_fields.hpp"
#include "geoloc/io/json/detection_fields.hpp"
#include "geoloc/io/partial_file.hpp"

namespace geoloc::io {
namespace {

namespace fs = std::filesystem;

std::ofstream open_for_writing(const fs::path& file) {
  errno = 0;
  std::ofstream output(file, std::ios::binary | std::ios::trunc);
  if (!output) fail_to_write(file, errno);
  return output;
}

/// Writes and flushes at once, so that a full disk is noticed at the record it affects and a crash loses
/// nothing.
void write_out(std::ofstream& output, const std::string& bytes, const fs::path& file) {
  errno = 0;
  output.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush();
  if (!output) fail_to_write(file, errno);
}

std::int64_t microseconds(HostTime time) {
  return std::chrono::floor<std::chrono::microseconds>(time.time_since_epoch()).count();
}

nlohmann::ordered_json to_json(const RecordedFrame& frame) {
  auto detections = nlohmann::ordered_json::array();
  for (const Detection& detection : frame.detections) detections.push_back(detection_to_json(detection));
  nlohmann::ordered_json line{{"time_us", microseconds(frame.captured_at)}};
  if (frame.time_sigma_s > 0.0) line["time_sigma_s"] = frame.time_sigma_s;
  if (!frame.time_quality.empty()) line["time_quality"] = frame.time_quality;
  line["detections"] = std::move(detections);
  if (frame.telemetry_records) line["telemetry_records"] = *frame.telemetry_records;
  return line;
}

}  // namespace

RecordingWriter::RecordingWriter(fs::path folder) : folder_(std::move(folder)) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // a trailing slash
  if (fs::exists(folder_) && (!fs::is_directory(folder_) || !fs::is_empty(folder_))) {
    throw std::runtime_error(folder_.string() + ": exists already; a recording needs a new folder");
  }
  partial_ = folder_;
  partial_ += ".partial";
  std::error_code error;
  fs::remove_all(partial_, error);
  fs::create_directories(partial_, error);
  if (error) fail_to_write(partial_, error.value());
  telemetry_ = open_for_writing(partial_ / "telemetry.tlog");
  frames_ = open_for_writing(partial_ / "frames.jsonl");
}

void RecordingWriter::write_extra(const std::string& name, const std::string& content) {
  const fs::path file = partial_ / name;
  std::ofstream output = open_for_writing(file);
  write_out(output, content, file);
}

void RecordingWriter::write_camera(const CameraConfig& camera) {
  write_extra("camera.json", camera_to_json(camera).dump(2) + "\n");
}

void RecordingWriter::write_config(const std::string& json) {
  write_extra("config.json", json + "\n");
}

void RecordingWriter::write_class_names(const std::vector<std::string>& names) {
  const nlohmann::json list(names);
  write_extra("class_names.json", list.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void RecordingWriter::write_truth(const std::vector<TrueTarget>& targets) {
  write_extra("truth.geojson", truth_to_geojson(targets));
}

void RecordingWriter::write_damaged(std::uint64_t frames) {
  write_extra("counts.json", nlohmann::json{{"frames_damaged", frames}}.dump() + "\n");
}

void RecordingWriter::add_telemetry(HostTime received_at, const std::uint8_t* frame, std::size_t size) {
  const auto stamp_us = static_cast<std::uint64_t>(microseconds(received_at));
  std::string record;
  record.reserve(8 + size);
  for (int shift = 56; shift >= 0; shift -= 8) record.push_back(static_cast<char>(stamp_us >> shift & 0xFF));
  record.append(reinterpret_cast<const char*>(frame), size);
  write_out(telemetry_, record, partial_ / "telemetry.tlog");
  ++telemetry_records_;
}

void RecordingWriter::add_frame(const RecordedFrame& frame) {
  write_out(frames_, to_json(frame).dump() + "\n", partial_ / "frames.jsonl");
}

void RecordingWriter::finish() {
  telemetry_.close();
  frames_.close();
  if (!telemetry_ || !frames_) fail_to_write(partial_, errno);
  std::error_code error;
  fs::remove(folder_, error);  // an empty folder of that name may exist
  fs::rename(partial_, folder_, error);
  if (error) fail_to_write(folder_, error.value());
}

std::string truth_to_geojson(const std::vector<TrueTarget>& targets) {
  auto features = nlohmann::ordered_json::array();
  for (const TrueTarget& target : targets) {
    nlohmann::ordered_json properties{{"id", target.id}, {"class_id", target.class_id}};
    if (target.height_above_home_m) properties["height_above_home_m"] = *target.height_above_home_m;
    features.push_back({{"type", "Feature"},
                        {"geometry",
                         {{"type", "Point"},
                          {"coordinates", {target.position.longitude_deg, target.position.latitude_deg}}}},
                        {"properties", std::move(properties)}});
  }
  const nlohmann::ordered_json collection{{"type", "FeatureCollection"}, {"features", std::move(features)}};
  return collection.dump(1) + "\n";
}

}  // namespace geoloc::io
