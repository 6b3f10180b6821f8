// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <utility>

#include "geoloc/io/stills/still.hpp"
#include "io/stills/tag_values.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

constexpr Duration kWidestZone = 14h;

/// `2016:06:23 16:32:43` of EXIF, `2016-06-23T16:32:43` of XMP; what follows is left in `rest`.
std::optional<Duration> date_in(const std::string& text, std::string& rest) {
  std::tm parts{};
  char first = 0, second = 0, middle = 0;
  int length = 0;
  const int found =
      std::sscanf(text.c_str(), "%4d%c%2d%c%2d%c%2d:%2d:%2d%n", &parts.tm_year, &first, &parts.tm_mon,
                  &second, &parts.tm_mday, &middle, &parts.tm_hour, &parts.tm_min, &parts.tm_sec, &length);
  const bool is_date =
      found == 9 && first == second && (first == ':' || first == '-') && (middle == ' ' || middle == 'T');
  const auto is_within = [](int value, int least, int most) { return value >= least && value <= most; };
  if (!is_date || !is_within(parts.tm_year, 1980, 2199) || !is_within(parts.tm_mon, 1, 12) ||
      !is_within(parts.tm_mday, 1, 31) || !is_within(parts.tm_hour, 0, 23) ||
      !is_within(parts.tm_min, 0, 59) || !is_within(parts.tm_sec, 0, 60))
    return std::nullopt;
  rest = text.substr(static_cast<std::size_t>(length));
  parts.tm_year -= 1900;
  parts.tm_mon -= 1;
  return std::chrono::seconds{timegm(&parts)};
}

/// The digits after the point of a second, `123` or `.123`.
std::optional<Duration> fraction_in(const std::string& text) {
  const std::size_t begin = text.rfind('.', 0) == 0 ? 1 : 0;
  const std::size_t end = std::min(text.find_first_not_of("0123456789", begin), text.size());
  if (end == begin || end - begin > 9) return std::nullopt;
  const auto fraction = number_in("0." + text.substr(begin, end - begin));
  if (!fraction) return std::nullopt;
  return from_seconds(*fraction);
}

/// `+02:00`, `-0330`, `Z`.
std::optional<Duration> zone_in(const std::string& text) {
  if (text.rfind('Z', 0) == 0) return Duration{};
  char sign = 0;
  int hours = 0, minutes = 0;
  const bool has_colon = std::sscanf(text.c_str(), "%c%2d:%2d", &sign, &hours, &minutes) == 3;
  if (!has_colon && std::sscanf(text.c_str(), "%c%2d%2d", &sign, &hours, &minutes) != 3) return std::nullopt;
  if ((sign != '+' && sign != '-') || hours < 0 || minutes < 0 || minutes > 59) return std::nullopt;
  const Duration size = std::chrono::hours{hours} + std::chrono::minutes{minutes};
  if (size > kWidestZone) return std::nullopt;
  return sign == '-' ? -size : size;
}

/// UTC to the second, as GNSS had it.
std::optional<Duration> gnss_time_of(const PictureTags& tags) {
  const auto date = tags.exif_text("GPSDateStamp");
  const auto time = tags.exif_text("GPSTimeStamp");
  if (!date || !time) return std::nullopt;
  const std::vector<double> clock = numbers_in(*time);
  std::string rest;
  const auto midnight = date_in(*date + " 00:00:00", rest);
  if (!midnight || clock.size() != 3) return std::nullopt;
  const double within_day_s = 3600.0 * clock[0] + 60.0 * clock[1] + clock[2];
  if (!(within_day_s >= 0.0 && within_day_s < 86401.0)) return std::nullopt;
  return *midnight + from_seconds(within_day_s);
}

/// Zones are whole quarters of an hour; what is left over is how far the camera's clock is off, which must be
/// little for the zone to be told.
std::optional<Duration> zone_by_gnss(Duration local, const PictureTags& tags) {
  constexpr Duration kQuarter = 15min, kMostOff = 3min;
  const auto gnss = gnss_time_of(tags);
  if (!gnss) return std::nullopt;
  const Duration ahead = local - *gnss;
  const Duration zone = kQuarter * std::llround(seconds(ahead) / seconds(kQuarter));
  const Duration off = ahead - zone;
  if (off > kMostOff || off < -kMostOff || zone > kWidestZone || zone < -kWidestZone) return std::nullopt;
  return zone;
}

std::optional<Duration> told_zone_of(const PictureTags& tags) {
  for (const char* name : {"OffsetTimeOriginal", "OffsetTimeDigitized", "OffsetTime"}) {
    const auto text = tags.exif_text(name);
    const auto zone = text ? zone_in(*text) : std::nullopt;
    if (zone) return zone;
  }
  return std::nullopt;
}

/// DJI's survey cameras write UTC, to the microsecond.
std::optional<CaptureTime> utc_at_exposure(const PictureTags& tags) {
  const auto text = tags.xmp_text("drone-dji:UTCAtExposure");
  std::string rest;
  const auto utc = text ? date_in(*text, rest) : std::nullopt;
  if (!utc) return std::nullopt;
  const auto fraction = fraction_in(rest);
  return CaptureTime{*utc + fraction.value_or(Duration{}), Duration{}, fraction.has_value()};
}

std::optional<CaptureTime> exif_time_of(const PictureTags& tags) {
  constexpr std::pair<const char*, const char*> kTags[] = {{"DateTimeOriginal", "SubSecTimeOriginal"},
                                                           {"DateTimeDigitized", "SubSecTimeDigitized"}};
  for (const auto& [date_tag, fraction_tag] : kTags) {
    const auto text = tags.exif_text(date_tag);
    std::string rest;
    const auto local = text ? date_in(*text, rest) : std::nullopt;
    if (!local) continue;
    const auto fraction = fraction_in(tags.exif_text(fraction_tag).value_or(""));
    return CaptureTime{*local + fraction.value_or(Duration{}), told_zone_of(tags), fraction.has_value()};
  }
  return std::nullopt;
}

std::optional<CaptureTime> xmp_time_of(const PictureTags& tags) {
  const auto text = tags.xmp_text("xmp:CreateDate");
  std::string rest;
  const auto local = text ? date_in(*text, rest) : std::nullopt;
  if (!local) return std::nullopt;
  const auto fraction = rest.rfind('.', 0) == 0 ? fraction_in(rest) : std::nullopt;
  const std::size_t zone = rest.find_first_of("+-Z");
  return CaptureTime{*local + fraction.value_or(Duration{}),
                     zone == std::string::npos ? std::nullopt : zone_in(rest.substr(zone)),
                     fraction.has_value()};
}

}  // namespace

std::optional<CaptureTime> capture_time_of(const PictureTags& tags) {
  if (const auto time = utc_at_exposure(tags)) return time;
  auto time = exif_time_of(tags);
  if (!time) time = xmp_time_of(tags);
  if (time && !time->utc_offset) time->utc_offset = zone_by_gnss(time->local, tags);
  return time;
}

}  // namespace geoloc::io
