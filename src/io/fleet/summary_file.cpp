// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/fleet/summary_file.hpp"

#include "geoloc/io/text_file.hpp"
#include "summary_checks.hpp"

namespace geoloc::io {

FlightSummary parse_summary(std::string_view content, const std::string& name) {
  if (content.empty()) refuse_summary(name, "is empty");
  return content.front() == '{' ? summary_from_json(content, name) : summary_from_bytes(content, name);
}

FlightSummary read_summary(const std::filesystem::path& file) {
  return parse_summary(read_text_file(file, kMostSummaryBytes), file.string());
}

}  // namespace geoloc::io
