// SPDX-License-Identifier: Apache-2.0
#include "io/logs/text_scan.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <ctime>

namespace geoloc::io {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// A whole number of exactly that many digits within bounds, and one of the separators behind it.
std::optional<int> take_part(std::string_view& text, std::size_t digits, int least, int most,
                             std::string_view separators) {
  if (text.size() < digits) return std::nullopt;
  int value = 0;
  for (const char c : text.substr(0, digits)) {
    if (!is_digit(c)) return std::nullopt;
    value = 10 * value + (c - '0');
  }
  text.remove_prefix(digits);
  if (value < least || value > most) return std::nullopt;
  if (separators.empty()) return value;
  if (text.empty() || separators.find(text.front()) == std::string_view::npos) return std::nullopt;
  text.remove_prefix(1);
  return value;
}

/// `.015`, or `,123,456` of DJI's older cameras.
Duration take_fraction(std::string_view& text) {
  constexpr std::size_t kGroup = 3, kMostDigits = 9;
  double unit_s = 0.1, fraction_s = 0.0;
  std::size_t digits = 0;
  while (text.size() >= 2 && (text[0] == '.' || text[0] == ',') && is_digit(text[1]) &&
         digits % kGroup == 0) {
    text.remove_prefix(1);
    for (; !text.empty() && is_digit(text[0]); text.remove_prefix(1)) {
      if (digits++ >= kMostDigits) continue;
      fraction_s += unit_s * (text[0] - '0');
      unit_s /= 10.0;
    }
  }
  return from_seconds(fraction_s);
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpaces = " \t\r";
  const std::size_t begin = text.find_first_not_of(kSpaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpaces) - begin + 1);
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

std::optional<double> take_number(std::string_view& text) {
  std::string_view rest = text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
  if (!rest.empty() && rest.front() == '+') rest.remove_prefix(1);
  double value = 0.0;
  const auto parsed = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (parsed.ec != std::errc{} || !std::isfinite(value)) return std::nullopt;
  text = rest.substr(static_cast<std::size_t>(parsed.ptr - rest.data()));
  return value;
}

std::optional<Duration> date_time_in(std::string_view text, std::string_view* rest) {
  const auto year = take_part(text, 4, 1980, 2199, "-.:/");
  const auto month = year ? take_part(text, 2, 1, 12, "-.:/") : std::nullopt;
  const auto day = month ? take_part(text, 2, 1, 31, " T") : std::nullopt;
  const auto hour = day ? take_part(text, 2, 0, 23, ":") : std::nullopt;
  const auto minute = hour ? take_part(text, 2, 0, 59, ":") : std::nullopt;
  const auto second = minute ? take_part(text, 2, 0, 60, "") : std::nullopt;
  if (!second) return std::nullopt;
  std::tm parts{};
  parts.tm_year = *year - 1900;
  parts.tm_mon = *month - 1;
  parts.tm_mday = *day;
  parts.tm_hour = *hour;
  parts.tm_min = *minute;
  parts.tm_sec = *second;
  const Duration whole = std::chrono::seconds{timegm(&parts)};
  const Duration fraction = take_fraction(text);
  if (rest != nullptr) *rest = text;
  return whole + fraction;
}

}  // namespace geoloc::io
