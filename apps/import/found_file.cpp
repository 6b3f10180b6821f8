// SPDX-License-Identifier: Apache-2.0
#include "import/found_file.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "geoloc/io/json/detection_fields.hpp"

namespace geoloc::apps {
namespace {

using Json = nlohmann::json;

/// Lines that a crash has cut off are no JSON.
constexpr std::uint64_t kSyncEvery = 100;

std::string to_line(const VideoLook& look) {
  nlohmann::ordered_json line{
      {"frame", look.frame}, {"time_ns", look.time.count()}, {"detections", Json::array()}};
  for (const Detection& detection : look.detections)
    line["detections"].push_back(io::detection_to_json(detection));
  return line.dump() + "\n";
}

VideoLook look_in(const std::string& line) {
  const Json value = Json::parse(line);
  VideoLook look;
  look.frame = value.at("frame").get<std::uint64_t>();
  look.time = Duration{value.at("time_ns").get<std::int64_t>()};
  for (const Json& detection : value.at("detections"))
    look.detections.push_back(io::detection_from_json(detection));
  return look;
}

/// Up to the first line that is none: it was being written when the program ended.
std::vector<VideoLook> read_looks(std::istream& input) {
  std::vector<VideoLook> looks;
  for (std::string line; std::getline(input, line);) {
    try {
      VideoLook look = look_in(line);
      if (!looks.empty() && look.frame <= looks.back().frame) break;
      looks.push_back(std::move(look));
    } catch (const std::exception&) {
      break;
    }
  }
  return looks;
}

}  // namespace

FoundFile::FoundFile(std::filesystem::path file, const std::string& work) : file_(std::move(file)) {
  std::ifstream input(file_);
  std::string first_line;
  if (std::getline(input, first_line)) {
    if (first_line != work)
      throw std::runtime_error(file_.string() +
                               ": holds what another detector found, or in another video; remove it, or name "
                               "another --out");
    looks_ = read_looks(input);
  }
  input.close();
  log_.emplace(file_);
  log_->append(work + "\n");
  for (const VideoLook& look : looks_) log_->append(to_line(look));
  log_->sync();
}

void FoundFile::add(VideoLook look) {
  log_->append(to_line(look));
  looks_.push_back(std::move(look));
  if (looks_.size() % kSyncEvery == 0) log_->sync();
}

void FoundFile::remove() {
  log_.reset();
  std::error_code ignored;  // it only takes room
  std::filesystem::remove(file_, ignored);
}

}  // namespace geoloc::apps
