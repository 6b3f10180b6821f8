// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/fleet/summary_file.hpp"

#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "summary_checks.hpp"

namespace geoloc::io {

FlightSummary parse_summary(std::string_view content, const std::string& name) {
  if (content.empty()) refuse_summary(name, "is empty");
  return content.front() == '{' ? summary_from_json(content, name) : summary_from_bytes(content, name);
}

FlightSummary read_summary(const std::filesystem::path& file) {
  std::error_code fault;
  if (std::filesystem::is_directory(file, fault))
    refuse_summary(file.string(), "is a folder; name the file that --summary wrote");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse_summary(file.string(), "cannot be opened: " + std::generic_category().message(errno));
  std::string content;
  std::array<char, 1 << 16> piece{};
  while (stream.read(piece.data(), piece.size()), stream.gcount() > 0) {
    content.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    if (content.size() > kMostSummaryBytes) refuse_summary(file.string(), "is larger than 256 MB");
  }
  if (stream.bad()) refuse_summary(file.string(), "cannot be read");
  return parse_summary(content, file.string());
}

}  // namespace geoloc::io
