// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/logs/log_formats.hpp"
#include "io/logs/log_builder.hpp"
#include "io/logs/text_scan.hpp"

namespace geoloc::io {
namespace {

[[noreturn]] void refuse(const std::string& reason) {
  throw std::runtime_error(reason);
}

struct Column {
  const char* name;
  double least, most;
};

/// All but `utc`, which is no number.
constexpr std::array<Column, 14> kColumns{{{"time_s", 0.0, 9e9},
                                           {"lat", -90.0, 90.0},
                                           {"lon", -360.0, 360.0},
                                           {"height_above_home_m", -1e5, 1e5},
                                           {"alt_msl_m", -1e5, 1e5},
                                           {"alt_ellipsoid_m", -1e5, 1e5},
                                           {"sigma_horizontal_m", 1e-3, 1e6},
                                           {"roll_deg", -360.0, 360.0},
                                           {"pitch_deg", -90.0, 90.0},
                                           {"yaw_deg", -360.0, 360.0},
                                           {"gimbal_roll_deg", -360.0, 360.0},
                                           {"gimbal_pitch_deg", -180.0, 180.0},
                                           {"gimbal_yaw_deg", -360.0, 360.0},
                                           {"focal_35mm_mm", 5.0, 2000.0}}};

std::vector<std::string_view> cells_of(std::string_view line) {
  constexpr std::size_t kMostColumns = 1000;
  std::vector<std::string_view> cells;
  for (bool is_more = true; is_more && cells.size() < kMostColumns;) {
    const std::size_t end = line.find(',');
    std::string_view cell = trimmed(line.substr(0, end));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    cells.push_back(cell);
    is_more = end != std::string_view::npos;
    if (is_more) line.remove_prefix(end + 1);
  }
  return cells;
}

/// Takes the lines after the first one.
class TableReader {
 public:
  explicit TableReader(std::string_view first_line) {
    const auto names = cells_of(first_line);
    const auto place_of = [&](std::string_view name) -> std::optional<std::size_t> {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end()) return std::nullopt;
      return static_cast<std::size_t>(found - names.begin());
    };
    utc_ = place_of("utc");
    for (std::size_t i = 0; i < kColumns.size(); ++i) places_[i] = place_of(kColumns[i].name);
    if (!utc_ && !places_[0]) refuse("there is no column `time_s` or `utc`");
    for (const char* wanted : {"lat", "lon"}) {
      if (!place_of(wanted)) refuse(std::string("there is no column `") + wanted + "`");
    }
  }

  void take(std::string_view line, FlightLog& log) const {
    const auto cells = cells_of(line);
    const VehicleTime time = time_of(cells, log);
    const auto number = [&](std::string_view name) { return number_in(cells, name); };
    if (const auto angles = angles_of(number("roll_deg"), number("pitch_deg"), number("yaw_deg")))
      keep(log.attitudes, {time, *angles});
    if (const auto angles =
            angles_of(number("gimbal_roll_deg"), number("gimbal_pitch_deg"), number("gimbal_yaw_deg")))
      keep(log.gimbal, {time, *angles, GimbalYaw::kFromNorth});
    if (const auto focal_mm = number("focal_35mm_mm")) keep_focal_length(log, {time, *focal_mm});
    const auto latitude_deg = number("lat"), longitude_deg = number("lon");
    if (!latitude_deg || !longitude_deg || !is_place({*latitude_deg, *longitude_deg})) return;
    const Geodetic place{*latitude_deg, *longitude_deg};
    const LoggedHeights heights{number("height_above_home_m"), number("alt_msl_m"),
                                number("alt_ellipsoid_m")};
    keep(log.positions, {time, place, heights});
    if (const auto sigma_m = number("sigma_horizontal_m"))
      keep(log.fixes, {time, place, heights.msl_m, 3, sigma_m, std::nullopt});
  }

 private:
  VehicleTime time_of(const std::vector<std::string_view>& cells, FlightLog& log) const {
    if (utc_) {
      const std::string_view text = *utc_ < cells.size() ? cells[*utc_] : "";
      std::string_view rest;
      const auto utc = date_time_in(text, &rest);
      if (!utc || (!rest.empty() && rest != "Z" && rest != "+00:00"))
        refuse("column `utc`: expected a time such as 2026-05-27T13:10:00.015Z, found `" + shown(text) + "`");
      const auto told = places_[0] ? number_in(cells, "time_s") : std::nullopt;
      const VehicleTime time{told ? from_seconds(*told) : *utc};
      keep(log.utc, {time, HostTime{*utc}});
      return time;
    }
    const auto time_s = number_in(cells, "time_s");
    if (!time_s) refuse("column `time_s`: is empty");
    return VehicleTime{from_seconds(*time_s)};
  }

  /// nullopt where the table has no such column, or nothing in it.
  std::optional<double> number_in(const std::vector<std::string_view>& cells, std::string_view name) const {
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      const Column& column = kColumns[i];
      if (column.name != name || !places_[i] || *places_[i] >= cells.size()) continue;
      std::string_view rest = cells[*places_[i]];
      if (rest.empty()) return std::nullopt;
      const auto value = take_number(rest);
      if (!value || !rest.empty())
        refuse("column `" + std::string(name) + "`: is no number: `" + shown(cells[*places_[i]]) + "`");
      if (!(*value >= column.least && *value <= column.most))
        refuse("column `" + std::string(name) + "`: " + shown(cells[*places_[i]]) + " is out of range");
      return value;
    }
    return std::nullopt;
  }

  static std::optional<EulerAngles> angles_of(std::optional<double> roll_deg, std::optional<double> pitch_deg,
                                              std::optional<double> yaw_deg) {
    if (!roll_deg || !pitch_deg || !yaw_deg) return std::nullopt;
    return EulerAngles{wrap_to_pi(*roll_deg * kRadPerDeg), *pitch_deg * kRadPerDeg,
                       wrap_to_pi(*yaw_deg * kRadPerDeg)};
  }

  static std::string shown(std::string_view text) { return std::string(text.substr(0, 40)); }

  std::optional<std::size_t> utc_;
  std::array<std::optional<std::size_t>, kColumns.size()> places_{};
};

}  // namespace

FlightLog parse_log_table(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
  FlightLog log;
  std::optional<TableReader> reader;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(take_line(text));
    if (line.empty() || line.front() == '#') continue;
    try {
      if (reader)
        reader->take(line, log);
      else
        reader.emplace(line);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("line " + std::to_string(number) + ": " + error.what());
    }
  }
  finish(log);
  return log;
}

}  // namespace geoloc::io
