// SPDX-License-Identifier: Apache-2.0
#include "transport_source.hpp"

#include <algorithm>
#include <cctype>

namespace geoloc::io {
namespace {

constexpr std::string_view kHeader = "transport:";
constexpr std::size_t kLongestHeader = 1024;

bool may_be_header(std::string_view line) {
  const auto length = std::min(line.size(), kHeader.size());
  return line.size() <= kLongestHeader &&
         std::equal(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(length), kHeader.begin(),
                    [](unsigned char a, char b) { return std::tolower(a) == b; });
}

}  // namespace

std::string TransportSource::edit(std::string_view bytes) {
  std::string passed;
  for (const char byte : bytes) {
    const bool is_end = byte == '\n';
    if (is_line_passing_) {
      passed += byte;
    } else if (!is_end && byte != '\r') {
      held_ += byte;
      is_line_passing_ = !may_be_header(held_);
    } else {
      const bool is_header = held_.size() > kHeader.size() && may_be_header(held_);
      if (is_header && held_.find("source=") == std::string::npos) held_ += ";source=" + address_;
      is_line_passing_ = true;
      held_ += byte;
    }
    if (is_line_passing_) {
      passed += held_;
      held_.clear();
    }
    if (is_end) is_line_passing_ = false;
  }
  return passed;
}

}  // namespace geoloc::io
