// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <cmath>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/logs/log_formats.hpp"
#include "io/logs/log_builder.hpp"
#include "io/logs/text_scan.hpp"

namespace geoloc::io {
namespace {

/// What stands behind a key: `[rel_alt: 5.400 abs_alt: 105.0]`, `[iso : 100]`, `BAROMETER:1.9`,
/// `BAROMETER(91.2)`, `GPS (a, b, c)`. nullopt where the key is not there as a word of its own.
std::optional<std::string_view> behind(std::string_view text, std::string_view key) {
  for (std::size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
    const bool is_begin =
        at == 0 || (std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0 && text[at - 1] != '_');
    const std::size_t end = std::min(text.find_first_not_of(' ', at + key.size()), text.size());
    if (!is_begin || end == text.size()) continue;
    if (text[end] == ':' || text[end] == '(') return text.substr(end + 1);
  }
  return std::nullopt;
}

std::optional<double> value_of(std::string_view text, std::string_view key) {
  auto rest = behind(text, key);
  return rest ? take_number(*rest) : std::nullopt;
}

/// `H 6.00m`.
std::optional<double> height_word(std::string_view text) {
  const std::size_t at = text.find(" H ");
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view rest = text.substr(at + 3);
  return take_number(rest);
}

/// `00:01:02,345`.
std::optional<Duration> take_subtitle_time(std::string_view& text) {
  const auto hours = take_number(text);
  double seconds_sum = 0.0;
  if (!hours || text.empty() || text.front() != ':') return std::nullopt;
  text.remove_prefix(1);
  const auto minutes = take_number(text);
  if (!minutes || text.empty() || text.front() != ':') return std::nullopt;
  text.remove_prefix(1);
  std::string_view whole = text.substr(0, std::min(text.find_first_of(",. "), text.size()));
  text.remove_prefix(whole.size());
  const auto full_seconds = take_number(whole);
  if (!full_seconds) return std::nullopt;
  if (!text.empty() && (text.front() == ',' || text.front() == '.')) {
    text.remove_prefix(1);
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    std::string_view fraction = text.substr(0, digits);
    text.remove_prefix(digits);
    if (digits > 0 && digits <= 9)
      seconds_sum += take_number(fraction).value_or(0.0) * std::pow(10.0, -static_cast<double>(digits));
  }
  seconds_sum += 3600.0 * *hours + 60.0 * *minutes + *full_seconds;
  constexpr double kLongest_s = 1e6;
  if (!(seconds_sum >= 0.0 && seconds_sum < kLongest_s)) return std::nullopt;
  return from_seconds(seconds_sum);
}

/// Takes the subtitles one by one.
class SubtitleCollector {
 public:
  void take(VehicleTime time, std::string_view text) {
    take_date(time, text);
    take_focal_length(time, text);
    take_gimbal(time, text);
    const auto place = place_of(text);
    if (!place || !is_place(*place)) return;
    LoggedHeights heights;
    for (const char* key : {"rel_alt", "BAROMETER"}) {
      if (!heights.above_home_m) heights.above_home_m = value_of(text, key);
    }
    if (!heights.above_home_m) heights.above_home_m = height_word(text);
    heights.msl_m = value_of(text, "abs_alt");
    if (!heights.msl_m) heights.msl_m = value_of(text, "altitude");
    keep(log_.positions, {time, *place, heights});
  }

  FlightLog finished() {
    if (is_order_taken_)
      log_.assumptions.emplace_back(
          is_latitude_first_
              ? "the subtitles' GPS(…) is taken to be latitude, longitude, as with BAROMETER(…)"
              : "the subtitles' GPS(…) is taken to be longitude, latitude, as DJI wrote it");
    log_.is_utc_local = true;
    finish(log_);
    return std::move(log_);
  }

 private:
  std::optional<Geodetic> place_of(std::string_view text) {
    const auto latitude_deg = value_of(text, "latitude");
    auto longitude_deg = value_of(text, "longitude");
    if (!longitude_deg) longitude_deg = value_of(text, "longtitude");  // Mavic 2 writes it so
    if (latitude_deg && longitude_deg) return Geodetic{*latitude_deg, *longitude_deg};
    auto rest = behind(text, "GPS");
    const auto first = rest ? take_number(*rest) : std::nullopt;
    if (!first || rest->empty() || rest->front() != ',') return std::nullopt;
    rest->remove_prefix(1);
    const auto second = take_number(*rest);
    if (!second) return std::nullopt;
    constexpr double kMostLatitude_deg = 90.0;
    const bool is_ambiguous = std::abs(*first) <= kMostLatitude_deg && std::abs(*second) <= kMostLatitude_deg;
    is_latitude_first_ = is_ambiguous ? text.find("BAROMETER(") != std::string_view::npos
                                      : std::abs(*first) <= kMostLatitude_deg;
    is_order_taken_ = is_order_taken_ || is_ambiguous;
    return is_latitude_first_ ? Geodetic{*first, *second} : Geodetic{*second, *first};
  }

  /// A date begins with four digits and a separator.
  void take_date(VehicleTime time, std::string_view text) {
    for (std::size_t at = 0; at + 10 <= text.size(); ++at) {
      if (text[at] != '1' && text[at] != '2') continue;
      if (const auto local = date_time_in(text.substr(at))) {
        keep(log_.utc, {time, HostTime{*local}});
        return;
      }
    }
  }

  /// In mm or, in older subtitles, tenths of them; a digital zoom narrows the view as a longer lens does.
  void take_focal_length(VehicleTime time, std::string_view text) {
    constexpr double kTenths = 100.0, kShortest_mm = 5.0, kLongest_mm = 2000.0, kZoomUnit = 1e4;
    auto focal_mm = value_of(text, "focal_len");
    if (!focal_mm) return;
    const auto rest = *behind(text, "focal_len");
    const bool has_point = rest.substr(0, rest.find_first_of("] ,", 1)).find('.') != std::string_view::npos;
    if (*focal_mm >= kTenths && !has_point) *focal_mm /= 10.0;
    double zoom = value_of(text, "dzoom_ratio").value_or(1.0);
    if (zoom >= 0.5 * kZoomUnit) zoom /= kZoomUnit;
    *focal_mm *= std::max(zoom, 1.0);
    if (!(*focal_mm >= kShortest_mm && *focal_mm <= kLongest_mm)) return;
    keep_focal_length(log_, {time, *focal_mm});
  }

  void take_gimbal(VehicleTime time, std::string_view text) {
    constexpr double kMost_deg = 360.0;
    const auto yaw_deg = value_of(text, "gb_yaw"), pitch_deg = value_of(text, "gb_pitch"),
               roll_deg = value_of(text, "gb_roll");
    if (!yaw_deg || !pitch_deg || !roll_deg) return;
    if (std::max({std::abs(*yaw_deg), std::abs(*pitch_deg), std::abs(*roll_deg)}) > kMost_deg) return;
    keep(log_.gimbal, {time,
                       {*roll_deg * kRadPerDeg, *pitch_deg * kRadPerDeg, wrap_to_pi(*yaw_deg * kRadPerDeg)},
                       GimbalYaw::kFromNorth});
  }

  FlightLog log_;
  bool is_latitude_first_ = false;
  bool is_order_taken_ = false;
};

}  // namespace

FlightLog parse_srt(std::string_view text) {
  constexpr std::string_view kArrow = "-->";
  SubtitleCollector collector;
  while (!text.empty()) {
    std::string_view line = trimmed(take_line(text));
    if (line.find(kArrow) == std::string_view::npos) continue;
    const auto begin = take_subtitle_time(line);
    const char* const first = text.data();
    std::size_t size = 0;  // of the subtitle, which an empty line ends
    while (!text.empty()) {
      const std::string_view next = take_line(text);
      if (trimmed(next).empty()) break;
      size = static_cast<std::size_t>(next.data() + next.size() - first);
    }
    if (begin) collector.take(VehicleTime{*begin}, {first, size});
  }
  return collector.finished();
}

}  // namespace geoloc::io
