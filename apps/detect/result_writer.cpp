// SPDX-License-Identifier: Apache-2.0
#include "detect/result_writer.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <stdexcept>
#include <system_error>

#include "detect/drawing.hpp"
#include "geoloc/io/atomic_file.hpp"
#include "geoloc/io/json/detection_fields.hpp"

namespace geoloc::apps {
namespace {

namespace fs = std::filesystem;

bool is_jpeg(const fs::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".jpg" || ending == ".JPG" || ending == ".jpeg" || ending == ".JPEG";
}

/// Pictures that are not JPEG become PNG, which loses nothing; videos become Matroska.
std::string drawn_name(const fs::path& file, bool is_video) {
  if (is_video) return file.stem().string() + ".mkv";
  return is_jpeg(file) ? file.filename().string() : file.stem().string() + ".png";
}

void check_drawn_names(const fs::path& folder, const std::vector<DetectInput>& inputs) {
  std::set<std::string> names;
  for (const DetectInput& input : inputs) {
    std::error_code no_such_folder;
    const fs::path parent = input.file.has_parent_path() ? input.file.parent_path() : fs::path(".");
    if (fs::equivalent(folder, parent, no_such_folder))
      throw std::runtime_error("--draw " + folder.string() +
                               ": holds what is to be looked at; name another folder");
    const std::string name = drawn_name(input.file, input.is_video);
    if (!names.insert(name).second)
      throw std::runtime_error("--draw: two inputs would be drawn to " + name +
                               "; do them one after the other");
  }
}

NamedFiles files_of(const ResultWriter::Places& places, const std::vector<DetectInput>& inputs) {
  NamedFiles files;
  if (places.json != "-") add_named(files, "--json", places.json);
  for (const DetectInput& input : inputs) {
    if (!places.draw.empty())
      files.push_back({"--draw", fs::path(places.draw) / drawn_name(input.file, input.is_video)});
  }
  return files;
}

NamedFiles files_of(const std::vector<DetectInput>& inputs) {
  NamedFiles files;
  for (const DetectInput& input : inputs) files.push_back({"INPUT", input.file});
  return files;
}

std::string line_for_a_person(const SeenPicture& picture, const std::vector<Detection>& detections,
                              const std::vector<std::string>& class_names) {
  std::string line = picture.file.string();
  if (picture.frame) line += fmt::format(" frame {} ({:.3f} s)", *picture.frame, picture.time_s);
  line += fmt::format(": {} found", detections.size());
  const char* separator = ": ";
  for (const Detection& detection : detections) {
    const Box& box = detection.box;
    line += fmt::format("{}{} {:.2f} at {:.1f} {:.1f} ({:.0f} x {:.0f} px)", separator,
                        class_names[static_cast<std::size_t>(detection.class_id)], detection.confidence,
                        box.x + 0.5 * box.width, box.y + 0.5 * box.height, box.width, box.height);
    separator = ", ";
  }
  return line + "\n";
}

}  // namespace

ResultWriter::ResultWriter(Places places, const std::vector<DetectInput>& inputs,
                           const NamedFiles& other_inputs, std::vector<std::string> class_names)
    : places_(std::move(places)), class_names_(std::move(class_names)) {
  if (!places_.draw.empty()) {
    check_drawn_names(places_.draw, inputs);
    std::error_code error;
    fs::create_directories(places_.draw, error);
    if (error) io::fail_to_write(places_.draw, error.value());
  }
  check_outputs(files_of(places_, inputs), joined({other_inputs, files_of(inputs)}));
  if (!places_.json.empty() && places_.json != "-") {
    partial_json_.emplace(places_.json);
    io::write_to(places_.json, [this] { json_.emplace(partial_json_->open()); });
  }
}

void ResultWriter::add(SeenPicture& picture, const std::vector<Detection>& detections) {
  if (!places_.json.empty()) {
    write_json(picture, detections);
  } else if (places_.draw.empty()) {
    std::fputs(line_for_a_person(picture, detections, class_names_).c_str(), stdout);
  }
  if (places_.draw.empty()) return;
  draw_detections(picture.bgr, detections, class_names_);
  if (picture.frame) {
    draw_frame(picture);
  } else {
    draw(picture);
  }
}

void ResultWriter::write_json(const SeenPicture& picture, const std::vector<Detection>& detections) {
  nlohmann::ordered_json line{{"image", picture.file.string()}};
  if (picture.frame) {
    line["frame"] = *picture.frame;
    line["time_s"] = picture.time_s;
  }
  line["detections"] = nlohmann::ordered_json::array();
  for (const Detection& detection : detections) {
    auto entry = io::detection_to_json(detection);
    entry["class_name"] = class_names_[static_cast<std::size_t>(detection.class_id)];
    line["detections"].push_back(std::move(entry));
  }
  // Names of files and classes may be any bytes.
  const std::string text = line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (!partial_json_) {
    std::fputs(text.c_str(), stdout);
    return;
  }
  io::write_to(places_.json, [&] { json_->write(text); });
}

void ResultWriter::draw(const SeenPicture& picture) {
  const fs::path file = fs::path(places_.draw) / drawn_name(picture.file, false);
  std::vector<unsigned char> bytes;
  if (!cv::imencode(is_jpeg(file) ? ".jpg" : ".png", picture.bgr, bytes))
    throw std::runtime_error(file.string() + ": cannot be encoded");
  io::write_file_atomically(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void ResultWriter::draw_frame(const SeenPicture& picture) {
  if (!video_) {
    video_ = std::make_unique<io::VideoFile>(fs::path(places_.draw) / drawn_name(picture.file, true),
                                             picture.bgr.size());
  }
  video_->add(picture.bgr, from_seconds(picture.time_s));
}

void ResultWriter::finish_video() {
  if (video_) video_->finish();
  video_.reset();
}

void ResultWriter::finish() {
  if (!partial_json_) return;
  io::write_to(places_.json, [this] { json_->close(); });
  partial_json_->commit();
}

}  // namespace geoloc::apps
