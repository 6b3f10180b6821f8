// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace geoloc {

/// A line of numbers that a script under tools/fixtures wrote: a word, perhaps a name, and its numbers.
struct NumberLine {
  std::string word;
  std::string name;
  std::vector<double> numbers;
};

inline NumberLine parse_number_line(const std::string& text) {
  std::istringstream stream(text);
  NumberLine line;
  stream >> line.word >> std::ws;
  if (std::isalpha(stream.peek()) != 0) stream >> line.name;
  for (double number = 0.0; stream >> number;) line.numbers.push_back(number);
  if (!stream.eof()) throw std::runtime_error("not a line of numbers: " + text);
  return line;
}

/// Throws std::runtime_error where the file cannot be read or is empty.
inline std::vector<NumberLine> read_number_lines(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<NumberLine> lines;
  for (std::string text; std::getline(file, text);) lines.push_back(parse_number_line(text));
  if (lines.empty()) throw std::runtime_error("cannot be read: " + path.string());
  return lines;
}

}  // namespace geoloc
