// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "geoloc/io/logs/log_formats.hpp"

// Logs of any bytes: they are refused with a std::exception, or what they tell is usable. Violations abort.
// Shared by the fuzz programs and by the test that damages good files.
namespace geoloc::io::hostile {

inline void require_told(bool holds) {
  if (!holds) std::abort();
}

inline void require_told(const std::optional<double>& value) {
  require_told(!value || std::isfinite(*value));
}

inline void require_told(const EulerAngles& angles) {
  require_told(std::isfinite(angles.roll_rad) && std::isfinite(angles.pitch_rad) &&
               std::isfinite(angles.yaw_rad));
}

template <typename Sample>
void require_order(const std::vector<Sample>& samples) {
  require_told(std::is_sorted(samples.begin(), samples.end(),
                              [](const Sample& a, const Sample& b) { return a.time < b.time; }));
}

inline void require_usable_log(const FlightLog& log, std::size_t size) {
  require_told(!log.positions.empty() && log.skipped_bytes <= size);
  for (const LoggedPosition& sample : log.positions) {
    require_told(is_valid(sample.position));
    require_told(sample.heights.above_home_m);
    require_told(sample.heights.msl_m);
    require_told(sample.heights.ellipsoid_m);
  }
  for (const AttitudeSample& sample : log.attitudes) require_told(sample.angles);
  for (const LoggedGimbal& sample : log.gimbal) require_told(sample.angles);
  for (const LoggedVelocity& sample : log.velocities) require_told(sample.velocity_in_enu.allFinite());
  for (const LoggedFix& fix : log.fixes) {
    require_told(is_valid(fix.position));
    require_told(!fix.sigma_horizontal_m || *fix.sigma_horizontal_m > 0.0);
  }
  for (const LoggedFocalLength& focal : log.focal_lengths) require_told(focal.equivalent_mm > 0.0);
  require_order(log.attitudes);
  require_order(log.positions);
  require_order(log.fixes);
  require_order(log.gimbal);
  require_order(log.camera_events);
}

inline void read_any_log(FlightLog (*parse)(std::string_view bytes), std::string_view bytes) {
  try {
    require_usable_log(parse(bytes), bytes.size());
  } catch (const std::exception&) {
  }
}

inline void read_any_dataflash(std::string_view bytes) {
  read_any_log(&parse_dataflash, bytes);
}

inline void read_any_ulog(std::string_view bytes) {
  read_any_log(&parse_ulog, bytes);
}

inline void read_any_srt(std::string_view text) {
  read_any_log(&parse_srt, text);
}

inline void read_any_log_table(std::string_view text) {
  read_any_log(&parse_log_table, text);
}

}  // namespace geoloc::io::hostile
