// SPDX-License-Identifier: Apache-2.0
#include "io/stills/tag_values.hpp"

#include <charconv>
#include <cmath>

namespace geoloc::io {
namespace {

std::string_view trimmed(std::string_view text, std::string_view unwanted) {
  const std::size_t begin = text.find_first_not_of(unwanted);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(unwanted) - begin + 1);
}

std::optional<double> plain_number_in(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  if (text.empty() || parsed.ec != std::errc{} || parsed.ptr != end || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> number_in(std::string_view text) {
  text = trimmed(text, " \t\r\n()");
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return plain_number_in(text);
  const auto above = plain_number_in(text.substr(0, slash));
  const auto below = plain_number_in(text.substr(slash + 1));
  if (!above || !below || !std::isfinite(*above / *below)) return std::nullopt;
  return *above / *below;
}

std::optional<double> number_of(const std::optional<std::string>& tag) {
  return tag ? number_in(*tag) : std::nullopt;
}

std::vector<double> numbers_in(std::string_view text, char separator) {
  std::vector<double> numbers;
  while (!text.empty()) {
    const std::size_t end = text.find(separator);
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (part.empty() && separator == ' ') continue;
    const auto number = number_in(part);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace geoloc::io
