// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/stills/labels.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "geoloc/io/json/detection_fields.hpp"
#include "io/json/plain_values.hpp"
#include "io/stills/survey_frame.hpp"
#include "io/stills/tag_values.hpp"

namespace geoloc::io {
namespace {

/// Boxes about a point that was marked: of no size that matters, but above joint.smallest_object_px.
constexpr double kMarkSize_px = 40.0;
/// People err, too.
constexpr double kMarkConfidence = 0.95;
constexpr double kLargestPixel = 1e6;
constexpr double kLargestClass = 1e6;
constexpr double kMostFrames = 1e9;

using Words = std::vector<std::string>;

[[noreturn]] void refuse(const std::string& reason) {
  throw std::runtime_error(reason);
}

double number(const std::string& text, const char* what) {
  const auto value = number_in(text);
  if (!value) refuse(std::string(what) + " is no number: `" + text.substr(0, 40) + "`");
  return *value;
}

double pixel(const std::string& text, const char* what) {
  const double value = number(text, what);
  if (!(std::abs(value) <= kLargestPixel)) refuse(std::string(what) + " lies beyond any picture");
  return value;
}

Box box_about(double u, double v, double width, double height) {
  if (!(width > 0.0 && height > 0.0 && width <= kLargestPixel && height <= kLargestPixel))
    refuse("width and height must be above 0");
  return {u + 0.5 - 0.5 * width, v + 0.5 - 0.5 * height, width, height};
}

Words words_of(const std::string& line) {
  std::istringstream input(line);
  Words words;
  for (std::string word; input >> word;) words.push_back(word);
  return words;
}

Words cells_of(const std::string& line) {
  Words cells;
  std::istringstream input(line);
  for (std::string cell; std::getline(input, cell, ',');) {
    const std::size_t begin = cell.find_first_not_of(" \t\"");
    const std::size_t end = cell.find_last_not_of(" \t\"");
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
  }
  return cells;
}

/// Takes the lines of a gcp_list.txt one by one.
class SurveyReader {
 public:
  explicit SurveyReader(const std::string& first_line) : frame_(first_line) {}

  void take(const std::string& line, Labels& labels) {
    const Words words = words_of(line);
    if (words.size() < 6) refuse("x y z u v picture is expected");
    const auto place = frame_.to_geodetic(number(words[0], "x"), number(words[1], "y"));
    if (!place) refuse("x and y are no place in the coordinate system of the first line");
    const double height_m = number(words[2], "z");
    Detection detection;
    detection.box = box_about(pixel(words[3], "u"), pixel(words[4], "v"), kMarkSize_px, kMarkSize_px);
    detection.confidence = kMarkConfidence;
    labels.by_picture[label_key(words[5])].push_back(detection);
    note_mark({words.size() > 6 ? words[6] : "", *place, height_m}, labels.marks);
  }

 private:
  /// Marks without a name are told apart by their places.
  static void note_mark(SurveyedMark mark, std::vector<SurveyedMark>& marks) {
    const bool is_known = std::any_of(marks.begin(), marks.end(), [&](const SurveyedMark& known) {
      if (!mark.name.empty()) return known.name == mark.name;
      return known.position.latitude_deg == mark.position.latitude_deg &&
             known.position.longitude_deg == mark.position.longitude_deg;
    });
    if (!is_known) marks.push_back(std::move(mark));
  }

  SurveyFrame frame_;
};

/// Takes the lines of a CSV one by one.
class TableReader {
 public:
  explicit TableReader(const std::string& first_line) : columns_(cells_of(first_line)) {
    for (const char* wanted : {"picture", "u", "v"}) {
      if (std::find(columns_.begin(), columns_.end(), wanted) == columns_.end())
        refuse(std::string("there is no column `") + wanted + "`");
    }
  }

  void take(const std::string& line, Labels& labels) const {
    const Words cells = cells_of(line);
    const std::string picture = cell(cells, "picture");
    if (picture.empty()) refuse("names no picture");
    std::vector<Detection>& detections = labels.by_picture[label_key(picture)];
    const std::string u = cell(cells, "u"), v = cell(cells, "v");
    if (u.empty() && v.empty()) return;  // nothing was seen
    Detection detection;
    const std::string width = cell(cells, "width"), height = cell(cells, "height");
    detection.box =
        box_about(pixel(u, "u"), pixel(v, "v"), width.empty() ? kMarkSize_px : number(width, "width"),
                  height.empty() ? kMarkSize_px : number(height, "height"));
    detection.confidence = confidence(cell(cells, "confidence"));
    detection.class_id = class_id(cell(cells, "class_id"));
    detections.push_back(detection);
  }

 private:
  std::string cell(const Words& cells, const char* column) const {
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    const auto position = static_cast<std::size_t>(found - columns_.begin());
    return found == columns_.end() || position >= cells.size() ? "" : cells[position];
  }

  static double confidence(const std::string& text) {
    const double value = text.empty() ? kMarkConfidence : number(text, "confidence");
    if (!(value >= 0.0 && value <= 1.0)) refuse("confidence must lie in [0, 1]");
    return value;
  }

  static int class_id(const std::string& text) {
    const double value = text.empty() ? 0.0 : number(text, "class_id");
    if (!(value >= 0.0 && value < kLargestClass && value == std::floor(value)))
      refuse("class_id must be a whole number from 0");
    return static_cast<int>(value);
  }

  Words columns_;
};

void take_class_name(const nlohmann::json& detection, int class_id, std::vector<std::string>& class_names) {
  constexpr int kMostNames = 10000;
  const auto name = detection.find("class_name");
  if (name == detection.end() || !name->is_string() || class_id >= kMostNames) return;
  const auto place = static_cast<std::size_t>(class_id);
  if (class_names.size() <= place) class_names.resize(place + 1);
  class_names[place] = name->get<std::string>();
}

/// A line that geoloc_detect wrote.
void take_json_line(const std::string& line, Labels& labels) {
  const nlohmann::json value = nlohmann::json::parse(line, nullptr, false);
  if (!value.is_object()) refuse("not a JSON object");
  const nlohmann::json& image = member(value, "image");
  const nlohmann::json& found = member(value, "detections");
  if (!image.is_string() || !found.is_array()) refuse("image must be a name, and detections a list");
  // A frame of a video goes by its number.
  const std::string picture = value.contains("frame")
                                  ? std::to_string(whole_number(value["frame"], "frame", kMostFrames))
                                  : image.get<std::string>();
  std::vector<Detection>& detections = labels.by_picture[label_key(picture)];
  for (const nlohmann::json& detection : found) {
    detections.push_back(detection_from_json(detection));
    take_class_name(detection, detections.back().class_id, labels.class_names);
  }
}

bool is_table(const std::string& first_line) {
  const Words columns = cells_of(first_line);
  return std::find(columns.begin(), columns.end(), "picture") != columns.end();
}

std::string without_end(std::string line) {
  while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back())) != 0) line.pop_back();
  return line;
}

/// What takes the lines after the first one.
using TakeLine = std::function<void(const std::string& line, Labels& labels)>;

TakeLine reader_for(const std::string& first_line) {
  if (is_table(first_line))
    return [table = TableReader(first_line)](const std::string& line, Labels& labels) {
      table.take(line, labels);
    };
  const auto survey = std::make_shared<SurveyReader>(first_line);
  return [survey](const std::string& line, Labels& labels) { survey->take(line, labels); };
}

}  // namespace

std::string label_key(const std::string& file_name) {
  std::string key = file_name.substr(file_name.find_last_of("/\\") + 1);
  std::transform(key.begin(), key.end(), key.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return key;
}

Labels parse_labels(const std::string& text, const std::string& name) {
  constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";
  std::istringstream input(text.rfind(kByteOrderMark, 0) == 0 ? text.substr(3) : text);
  Labels labels;
  TakeLine take;
  std::size_t number = 0;
  for (std::string line; std::getline(input, line);) {
    ++number;
    line = without_end(std::move(line));
    if (line.empty()) continue;
    try {
      if (take) {
        take(line, labels);
      } else if (line.front() == '{') {
        take = &take_json_line;
        take(line, labels);
      } else {
        take = reader_for(line);
      }
    } catch (const std::exception& error) {
      throw std::runtime_error(name + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  if (labels.by_picture.empty()) throw std::runtime_error(name + ": holds no label");
  return labels;
}

}  // namespace geoloc::io
