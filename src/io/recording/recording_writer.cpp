// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/recording/recording_writer.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <variant>

#include "geoloc/io/json/camera_fields.hpp"
#include "geoloc/io/json/detection_fields.hpp"
#include "geoloc/io/recording/notes_file.hpp"
#include "geoloc/io/recording/recording_files.hpp"
#include "geoloc/io/recording/tlog.hpp"
#include "geoloc/io/sync.hpp"
#include "geoloc/io/write_failure.hpp"

namespace geoloc::io {
namespace {

namespace fs = std::filesystem;

/// Makes the folder and those above it that are missing; their names survive a power cut.
void make_folders(const fs::path& folder) {
  if (folder.empty() || fs::is_directory(folder)) return;
  make_folders(folder.parent_path());
  if (::mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST) fail_to_write(folder, errno);
  sync_name(folder);
}

/// False where something of that name exists: who makes it first has it.
bool make_new_folder(const fs::path& folder) {
  make_folders(folder.parent_path());
  if (::mkdir(folder.c_str(), 0777) == 0) {
    sync_name(folder);
    return true;
  }
  if (errno != EEXIST) fail_to_write(folder, errno);
  return false;
}

/// An empty folder is as good as none.
bool is_in_use(const fs::path& name) {
  return fs::exists(fs::symlink_status(name)) && (!fs::is_directory(name) || !fs::is_empty(name));
}

bool is_recording(const fs::path& folder) {
  return fs::exists(folder / kTelemetryFile) && fs::exists(folder / kFramesFile);
}

/// `flight`, `flight-2`, `flight-3`, …
fs::path numbered(const fs::path& folder, int number) {
  fs::path name = folder;
  if (number > 1) name += "-" + std::to_string(number);
  return name;
}

std::int64_t microseconds(HostTime time) {
  return std::chrono::floor<std::chrono::microseconds>(time.time_since_epoch()).count();
}

/// A frame's own mount is one on the body, unless it says otherwise: every line would repeat it.
nlohmann::ordered_json own_mount_to_json(const CameraMount& mount) {
  nlohmann::ordered_json object = mount_to_json(mount);
  if (mount.kind == MountKind::kFixed) object.erase("kind");
  return object;
}

nlohmann::ordered_json to_json(const RecordedFrame& frame) {
  auto detections = nlohmann::ordered_json::array();
  for (const Detection& detection : frame.detections) detections.push_back(detection_to_json(detection));
  nlohmann::ordered_json line{{"time_us", microseconds(frame.captured_at)}};
  if (frame.time_sigma_s > 0.0) line["time_sigma_s"] = frame.time_sigma_s;
  if (!frame.time_quality.empty()) line["time_quality"] = frame.time_quality;
  if (frame.mount) line["mount"] = own_mount_to_json(*frame.mount);
  if (frame.focal_px) line["focal_px"] = {frame.focal_px->x(), frame.focal_px->y()};
  line["detections"] = std::move(detections);
  if (frame.telemetry_records) line["telemetry_records"] = *frame.telemetry_records;
  return line;
}

}  // namespace

std::string frame_to_line(const RecordedFrame& frame) {
  return to_json(frame).dump() + "\n";
}

RecordingWriter::Place RecordingWriter::make_place(fs::path folder, NameTaken name_taken) {
  if (!folder.has_filename()) folder = folder.parent_path();  // a trailing slash
  for (int number = 1;; ++number) {
    Place place{numbered(folder, number), {}};
    place.partial = place.folder;
    place.partial += ".partial";
    const bool is_taken = is_in_use(place.folder);
    if (!is_taken && make_new_folder(place.partial)) return place;
    const bool may_number = name_taken == NameTaken::kNumber;
    if (is_taken && !(may_number && is_recording(place.folder)))
      throw std::runtime_error(place.folder.string() + ": exists already; a recording needs a new folder");
    if (!is_taken && !may_number)
      throw std::runtime_error(place.partial.string() +
                               ": exists already, from a run that goes on or was cut off; name another "
                               "folder, or move it away");
  }
}

RecordingWriter::RecordingWriter(fs::path folder, NameTaken name_taken)
    : name_taken_(name_taken),
      place_(make_place(std::move(folder), name_taken)),
      telemetry_(place_.partial / kTelemetryFile),
      frames_(place_.partial / kFramesFile) {
  io::sync(place_.partial);
}

void RecordingWriter::write_extra(const std::string& name, const std::string& content) {
  LogFile file(place_.partial / name);
  file.append(content);
  file.finish();
  io::sync(place_.partial);
}

void RecordingWriter::write_camera(const CameraConfig& camera) {
  write_extra(kCameraFile, camera_to_json(camera).dump(2) + "\n");
}

void RecordingWriter::write_config(const std::string& json) {
  write_extra(kConfigFile, json + "\n");
}

void RecordingWriter::write_class_names(const std::vector<std::string>& names) {
  const nlohmann::json list(names);
  write_extra(kClassNamesFile, list.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void RecordingWriter::write_truth(const std::vector<TrueTarget>& targets) {
  write_extra(kTruthFile, truth_to_geojson(targets));
}

void RecordingWriter::write_damaged(std::uint64_t frames) {
  write_extra(kCountsFile, nlohmann::json{{"frames_damaged", frames}}.dump() + "\n");
}

void RecordingWriter::add_telemetry(HostTime received_at, const std::uint8_t* frame, std::size_t size) {
  const auto stamp = tlog_stamp(std::chrono::microseconds{microseconds(received_at)});
  std::string record;
  record.reserve(stamp.size() + size);
  record.append(stamp.begin(), stamp.end());
  record.append(reinterpret_cast<const char*>(frame), size);
  telemetry_.append(record);
  ++telemetry_records_;
}

void RecordingWriter::add_frame(const RecordedFrame& frame) {
  frames_.append(frame_to_line(frame));
}

void RecordingWriter::add_note(const NotedObject& noted) {
  if (!notes_) {
    notes_.emplace(place_.partial / kNotesFile);
    io::sync(place_.partial);
  }
  notes_->append(note_to_line(noted));
}

fs::path RecordingWriter::picture_file(std::uint64_t object_id) const {
  return place_.partial / kPicturesFolder / (std::to_string(object_id) + ".jpg");
}

void RecordingWriter::remove_picture(std::uint64_t object_id) {
  std::error_code ignored;  // one too many does no harm
  fs::remove(picture_file(object_id), ignored);
}

void RecordingWriter::write_picture(std::uint64_t object_id, const std::string& jpeg) {
  const fs::path picture = picture_file(object_id);
  make_folders(picture.parent_path());
  // Not synced: the estimate is worth the disk's time, a picture is not.
  write_to(picture, [&] {
    OutputStream stream = OutputStream::file(picture);
    stream.write(jpeg);
    stream.close();
  });
}

void RecordingWriter::sync() {
  telemetry_.sync();
  frames_.sync();
  if (notes_) notes_->sync();
}

void RecordingWriter::finish() {
  telemetry_.finish();
  frames_.finish();
  if (notes_) notes_->finish();
  const fs::path wanted = place_.folder;
  for (int number = 2; ::rename(place_.partial.c_str(), place_.folder.c_str()) != 0; ++number) {
    // Another run may have taken the name since; rename() replaces no folder but an empty one.
    const bool is_taken = errno == ENOTEMPTY || errno == EEXIST || errno == ENOTDIR;
    if (!is_taken || name_taken_ == NameTaken::kRefuse) fail_to_write(place_.folder, errno);
    place_.folder = numbered(wanted, number);
  }
  sync_name(place_.folder);
}

std::string truth_to_geojson(const std::vector<TrueTarget>& targets) {
  auto features = nlohmann::ordered_json::array();
  for (const TrueTarget& target : targets) {
    nlohmann::ordered_json properties;
    std::visit([&properties](const auto& id) { properties["id"] = id; }, target.id);
    properties["class_id"] = target.class_id;
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
