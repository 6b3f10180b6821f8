// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/recording/notes_file.hpp"

#include <cerrno>
#include <fstream>
#include <istream>
#include <nlohmann/json.hpp>
#include <optional>

#include "geoloc/io/recording/recording_files.hpp"
#include "geoloc/io/write_failure.hpp"

namespace geoloc::io {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestLine = 16384;
constexpr std::size_t kLongestName_bytes = 1000;
constexpr std::int64_t kLatestNote_us = 7'258'118'400'000'000;  // year 2200

std::optional<Geodetic> position_of(const json& value) {
  const bool is_pair = value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
  if (!is_pair) return std::nullopt;
  const Geodetic position{value[1].get<double>(), value[0].get<double>()};
  return is_valid(position) ? std::optional(position) : std::nullopt;
}

std::optional<NotedObject> parse_note(const std::string& line) {
  const json value = line.size() > kLongestLine ? json() : json::parse(line, nullptr, false);
  if (!value.is_object()) return std::nullopt;
  const auto time = value.find("time_us"), object = value.find("object"), place = value.find("coordinates");
  const auto name = value.find("name"), verdict = value.find("verdict");
  const bool has_types = time != value.end() && time->is_number_unsigned() && object != value.end() &&
                         object->is_number_unsigned() && place != value.end() && name != value.end() &&
                         name->is_string() && verdict != value.end() && verdict->is_string();
  if (!has_types || time->get<std::uint64_t>() > kLatestNote_us) return std::nullopt;
  const auto position = position_of(*place);
  const auto its_verdict = parse_verdict(verdict->get<std::string>());
  if (!position || !its_verdict || name->get_ref<const std::string&>().size() > kLongestName_bytes)
    return std::nullopt;
  return NotedObject{HostTime{std::chrono::microseconds{time->get<std::int64_t>()}},
                     object->get<std::uint64_t>(),
                     *position,
                     {name->get<std::string>(), *its_verdict}};
}

/// A power cut may have left a line without its end.
bool ends_within_line(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary | std::ios::ate);
  if (!input || input.tellg() <= 0) return false;
  input.seekg(-1, std::ios::end);
  return input.get() != '\n';
}

}  // namespace

std::string note_to_line(const NotedObject& noted) {
  const auto time = std::chrono::floor<std::chrono::microseconds>(noted.at.time_since_epoch()).count();
  const nlohmann::ordered_json line{
      {"time_us", time},
      {"object", noted.object_id},
      {"coordinates", {noted.position.longitude_deg, noted.position.latitude_deg}},
      {"name", noted.note.name},
      {"verdict", word_of(noted.note.verdict)}};
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::vector<NotedObject> read_notes(std::istream& input, std::size_t& skipped_lines) {
  std::vector<NotedObject> notes;
  for (std::string line; std::getline(input, line);) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (auto note = parse_note(line)) {
      notes.push_back(std::move(*note));
    } else {
      ++skipped_lines;
    }
  }
  return notes;
}

void append_notes(const std::filesystem::path& folder, const std::vector<NotedObject>& notes) {
  const std::filesystem::path file = folder / kNotesFile;
  std::string lines = ends_within_line(file) ? "\n" : "";
  for (const NotedObject& note : notes) lines += note_to_line(note);
  errno = 0;
  std::ofstream output(file, std::ios::binary | std::ios::app);
  output << lines << std::flush;
  if (!output) fail_to_write(file, errno);
}

}  // namespace geoloc::io
